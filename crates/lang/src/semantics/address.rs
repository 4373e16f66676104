//! Addresses of directly represented variables, like `%IX0.0` (IEC 61131-3, 2.4.1.1).

use std::collections::BTreeSet;

use super::shape::{Scalar, Shape, Value};
use super::symbols::{Section, Symbol, Symbols};
use super::uses;
use crate::syntax::ast::{Name, Path, Unit, key};
use crate::syntax::standard_address;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::{Kind, Type};

/// Area of an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Area {
    /// `%I`
    Input,
    /// `%Q`
    Output,
    /// `%M`
    Memory,
}

/// Address of a variable.
#[derive(Clone, Debug)]
pub struct Location {
    pub area: Area,
    /// Text as written.
    pub text: String,
    /// Span in the text.
    pub span: Span,
}

/// Normalised spelling of an address, equal for all its spellings: `%ix0.0` and `%I0.0` are `%I0.0`.
#[must_use]
pub fn spelling(text: &str) -> String {
    let text = key(text);
    match text.as_bytes() {
        [b'%', _, b'X', ..] => format!("{}{}", &text[..2], &text[3..]),
        _ => text,
    }
}

/// Reads area and size of an address like `%IX0.0`; `%I0.0` has no size. `None` if the text is not an address.
pub fn read(text: &str) -> Option<(Area, Option<Type>)> {
    let text = text.to_ascii_uppercase();
    let mut letters = text.strip_prefix('%')?.chars();
    let area = match letters.next()? {
        'I' => Area::Input,
        'Q' => Area::Output,
        'M' => Area::Memory,
        _ => return None,
    };
    let mut rest = letters.as_str();
    let size = rest.chars().next().filter(char::is_ascii_alphabetic);
    let width = match size {
        None => None,
        Some('X') => Some(1),
        Some('B') => Some(8),
        Some('W') => Some(16),
        Some('D') => Some(32),
        Some('L') => Some(64),
        Some(_) => return None,
    };
    if size.is_some() {
        rest = &rest[1..];
    }
    let numbers = rest.split('.').all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()));
    numbers.then(|| (area, width.map(|width| Type::new(Kind::Bits, width))))
}

/// Error for an address that cannot be read.
pub fn unreadable(address: &Name) -> Diagnostic {
    let message = format!("`{}` is no address that can be read", address.text);
    let help = match standard_address(&address.text) {
        Some(standard) => {
            format!("an address begins with `%`, with I for an input and Q for an output: write `{standard}`")
        }
        None => "an address is like `%IX0.0`, `%QW3` or `%MD12`".to_owned(),
    };
    Diagnostic::new(Code::AddressUnfit, address.span, message).help(help)
}

/// Checks that an address fits its variable.
pub fn fit(location: &Name, symbol: &Symbol, may_locate: bool) -> Result<Location, Diagnostic> {
    let unfit =
        |message: String, help: &str| Err(Diagnostic::new(Code::AddressUnfit, location.span, message).help(help));
    let Some((area, size)) = read(&location.text) else {
        return Err(unreadable(location));
    };
    if !may_locate {
        let message = format!("`{}` stands where no address may", location.text);
        return unfit(message, "only variables of programs and global variables have addresses");
    }
    let fits = match (symbol.section, area) {
        (Section::Input, area) => area == Area::Input,
        (Section::Output, area) => area == Area::Output,
        (Section::Local, _) => true,
        _ => false,
    };
    if !fits {
        let message = format!("`{}` is no address for `{}`", location.text, symbol.name);
        return unfit(message, "inputs are at `%I…`, outputs at `%Q…`, memory at `%M…`");
    }
    let width = symbol.shape.as_ref().and_then(Shape::scalar).map(|scalar| scalar.ty.width);
    match (size, width) {
        (Some(size), Some(width)) if size.width != width => {
            let bits = |n| if n == 1 { "1 bit".to_owned() } else { format!("{n} bits") };
            let (own, needed) = (bits(size.width), bits(width));
            let message = format!("`{}` has {own}, but `{}` needs {needed}", location.text, symbol.name);
            unfit(message, "X stands for one bit, B for 8, W for 16, D for 32, L for 64")
        }
        _ => Ok(Location { area, text: location.text.clone(), span: location.span }),
    }
}

/// Adds a global variable for every address that the units of a file use without a declaration.
pub fn undeclared(unit: &Unit, globals: &mut Symbols) {
    let mut paths: Vec<&Path> = Vec::new();
    for pou in &unit.pous {
        let declared = pou.blocks.iter().flat_map(|block| &block.declarations).filter_map(|d| d.location.as_ref());
        let declared: BTreeSet<String> = declared.map(|location| spelling(&location.text)).collect();
        let used = uses::paths(&pou.body, None)
            .into_iter()
            .map(|(path, _)| path)
            .filter(|path| path.root.text.starts_with('%'));
        paths.extend(used.filter(|path| !declared.contains(&spelling(&path.root.text))));
    }
    for path in paths {
        let Some((area, ty)) = read(&path.root.text) else { continue };
        if globals.find(&path.root.text).is_some() {
            continue;
        }
        let symbol = Symbol {
            name: spelling(&path.root.text),
            span: path.root.span,
            section: Section::Local,
            shape: Some(Shape::Scalar(Scalar::new(ty.unwrap_or(Type::BOOL)))),
            initial: Value::Default,
            is_given: false,
            location: Some(Location { area, text: path.root.text.clone(), span: path.root.span }),
        };
        let _ = globals.add(symbol);
    }
}
