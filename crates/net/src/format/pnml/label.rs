//! Attributes and labels of PNML elements, with their positions.

use crate::format::draft::MAX_COUNT;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::xml::{Element, Event, Piece, Stream};

/// Required attribute.
pub fn required<'s>(element: &Element<'s>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Piece<'s>> {
    let attribute = element.attribute(name);
    if attribute.is_none() {
        let message = format!("this `<{}>` has no attribute `{name}`", element.name);
        diagnostics.push(Diagnostic::new(Code::NetSyntax, element.span, message));
    }
    attribute
}

/// Content of the `<text>` of the label that began last. Reads to the end of the label.
pub fn text<'s>(stream: &mut Stream<'s>) -> Result<Option<Piece<'s>>, Diagnostic> {
    let mut text = None;
    loop {
        match stream.event()? {
            Some(Event::Start(element)) if element.name == "text" && text.is_none() => {
                text = Some(stream.content(&element)?);
            }
            Some(Event::Start(_)) => stream.skip()?,
            Some(Event::Text(_)) => {}
            Some(Event::End) | None => return Ok(text),
        }
    }
}

/// Natural number of the label that began last, with its position. Reads to the end of the label.
pub fn number<'s>(
    stream: &mut Stream<'s>,
    label: &Element<'s>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<(u64, Span)>, Diagnostic> {
    let Some(Piece { text, span }) = text(stream)? else {
        let message = format!("this `<{}>` has no `<text>`", label.name);
        diagnostics.push(Diagnostic::new(Code::NetSyntax, label.span, message));
        return Ok(None);
    };
    if text.is_empty() || !text.bytes().all(|b| b.is_ascii_digit()) {
        let message = format!("`{text}` is no natural number");
        diagnostics.push(Diagnostic::new(Code::NetSyntax, span, message));
        return Ok(None);
    }
    let number = text.parse().ok().filter(|&number| number <= MAX_COUNT);
    if number.is_none() {
        let message = format!("{text} tokens are more than can be counted");
        diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, span, message).help("write a smaller number"));
    }
    Ok(number.map(|number| (number, span)))
}
