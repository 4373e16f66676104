//! Keys of a project file: each corresponds to an option of `petril check`.

use std::error::Error;

use clap::error::{ContextKind, ContextValue};
use clap::{Args, Command};
use petril::diagnostic::{Code, Diagnostic};
use petril::source::Span;
use toml::Spanned;
use toml::de::DeValue;

use crate::cli::args::Check;

/// Key for the options of a check.
pub struct Key {
    /// Spelling of the key.
    pub name: &'static str,
    /// Corresponding option.
    option: &'static str,
    kind: Kind,
}

/// Type of a key's value.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Text or number.
    Word,
    /// Boolean.
    Switch,
    /// Text, or list of texts.
    Texts,
    /// Text or list of texts, as paths relative to the folder of the project file.
    Paths,
}

const fn key(name: &'static str, option: &'static str, kind: Kind) -> Key {
    Key { name, option, kind }
}

/// Keys, in the order of the guide.
pub const KEYS: [Key; 15] = [
    key("plants", "plant", Kind::Paths),
    key("requirements", "require", Kind::Paths),
    key("formulas", "requirement", Kind::Texts),
    key("domains", "domain", Kind::Texts),
    key("fairness", "fairness", Kind::Texts),
    key("view", "view", Kind::Word),
    key("fair", "fair", Kind::Switch),
    key("pou", "pou", Kind::Word),
    key("scan-time", "scan-time", Kind::Word),
    key("strict", "strict", Kind::Switch),
    key("overflow", "overflow", Kind::Word),
    key("div0", "div0", Kind::Word),
    key("max-states", "max-states", Kind::Word),
    key("max-memory", "max-memory", Kind::Word),
    key("timeout", "timeout", Kind::Word),
];

/// Value of a key, as arguments of its option.
#[derive(Clone)]
pub struct Setting {
    option: &'static str,
    kind: Kind,
    values: Vec<String>,
}

impl Setting {
    /// Reads the value of a key.
    pub fn read(key: &'static Key, value: &Spanned<DeValue<'_>>) -> Result<Self, Vec<Diagnostic>> {
        let Key { name, option, kind } = *key;
        let wanted = |what: &str| Diagnostic::new(Code::ProjectValue, span(value), format!("`{name}` takes {what}"));
        let values = match (kind, value.get_ref()) {
            (Kind::Word, DeValue::String(text)) => vec![text.to_string()],
            (Kind::Word, DeValue::Integer(number)) => vec![number.as_str().replace('_', "")],
            (Kind::Word, DeValue::Float(number)) => vec![number.as_str().replace('_', "")],
            (Kind::Word, _) => return Err(vec![wanted("a text or a number")]),
            (Kind::Switch, DeValue::Boolean(true)) => vec![String::new()],
            (Kind::Switch, DeValue::Boolean(false)) => vec![],
            (Kind::Switch, _) => return Err(vec![wanted("`true` or `false`")]),
            (Kind::Texts | Kind::Paths, _) => texts(name, value)?,
        };
        if let (Kind::Word, [text]) = (kind, values.as_slice()) {
            refused(option, text).map_or(Ok(()), |help| {
                let message = format!("`{text}` is no value of `{name}`");
                Err(vec![Diagnostic::new(Code::ProjectValue, span(value), message).help(help)])
            })?;
        }
        Ok(Self { option, kind, values })
    }

    /// Whether this setting overrides another one. Lists are appended instead.
    pub fn replaces(&self, other: &Self) -> bool {
        self.option == other.option && matches!(self.kind, Kind::Word | Kind::Switch)
    }

    /// Command-line arguments, with file names mapped by `path`.
    pub fn arguments<'s>(&'s self, path: &'s dyn Fn(&str) -> String) -> impl Iterator<Item = String> + 's {
        self.values.iter().map(move |value| match self.kind {
            Kind::Switch => format!("--{}", self.option),
            Kind::Paths => format!("--{}={}", self.option, path(value)),
            Kind::Word | Kind::Texts => format!("--{}={value}", self.option),
        })
    }
}

/// Reads a text, or a list of texts.
pub fn texts(name: &str, value: &Spanned<DeValue<'_>>) -> Result<Vec<String>, Vec<Diagnostic>> {
    let wanted = |value: &Spanned<DeValue<'_>>| {
        let message = format!("`{name}` takes a text, or a list of texts");
        Diagnostic::new(Code::ProjectValue, span(value), message).help("write it like `[\"one\", \"two\"]`")
    };
    match value.get_ref() {
        DeValue::String(text) => Ok(vec![text.to_string()]),
        DeValue::Array(values) => {
            let text = |value: &Spanned<DeValue<'_>>| value.get_ref().as_str().map(str::to_owned);
            let wrong: Vec<_> = values.iter().filter(|value| text(value).is_none()).map(wanted).collect();
            if wrong.is_empty() { Ok(values.iter().filter_map(text).collect()) } else { Err(wrong) }
        }
        _ => Err(vec![wanted(value)]),
    }
}

/// Span of a value.
pub fn span<T>(value: &Spanned<T>) -> Span {
    Span::new(value.span().start, value.span().end)
}

/// Error of the command line for a value, if it rejects it.
fn refused(option: &str, value: &str) -> Option<String> {
    let command = Check::augment_args(Command::new("check"));
    let error = command
        .try_get_matches_from([
            "check".to_owned(),
            format!("--{option}={value}"),
            "--".to_owned(),
            "program".to_owned(),
        ])
        .err()?;
    Some(match (error.get(ContextKind::ValidValue), error.source()) {
        (Some(ContextValue::Strings(values)), _) if !values.is_empty() => format!("it is one of {}", values.join(", ")),
        (_, Some(reason)) => reason.to_string(),
        _ => format!("`petril check --help` says what `--{option}` takes"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_an_option() {
        let command = Check::augment_args(Command::new("check"));
        for Key { name, option, .. } in &KEYS {
            assert!(command.get_arguments().any(|argument| argument.get_long() == Some(option)), "{name}");
        }
    }
}
