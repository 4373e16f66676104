//! Properties of PLCverif in JSON, as in its benchmarks: patterns with parameters.
//!
//! ```json
//! { "id": "press", "properties_to_be_validated": [ { "property_description": "…", "property": {
//!     "job_req": "pattern", "pattern_id": "pattern-implication", "pattern_params": { "1": "instance.a", "2": "instance.b" },
//!     "pattern_description": "If {1} is true at the end of the PLC cycle, then {2} should always be true at the end of the same cycle."
//! } } ] }
//! ```

use serde_json::{Map, Value};

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Property in a file, before it is parsed as a requirement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Name: that of the task and the property's position, from 1.
    pub name: String,
    /// Sentence given by the author.
    pub sentence: Option<String>,
    /// Question asked.
    pub asked: Asked,
}

/// Question of a property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Asked {
    /// Pattern: its short form, and its sentence with the parameters filled in, which may be arbitrary prose.
    Pattern {
        /// `pattern-implication({a}, {b})`
        short: String,
        /// `If {a} is true …`
        described: Option<String>,
    },
    /// The assertions of the program hold.
    Assertions,
}

/// Reads the properties of a file.
///
/// # Errors
/// The text is not JSON, has no properties, or has an invalid one.
pub fn properties(text: &str) -> Result<Vec<Property>, Diagnostic> {
    let refused = |span, message: String| {
        let help = "properties are like `{ \"property\": { \"job_req\": \"pattern\", \"pattern_id\": \"pattern-invariant\", \
                    \"pattern_params\": { \"1\": \"a\" } } }`";
        Diagnostic::new(Code::RequirementSyntax, span, message).help(help)
    };
    let document: Value = serde_json::from_str(text).map_err(|error| {
        let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
        let at = (before + error.column().saturating_sub(1)).min(text.len());
        let at = (0..=at).rev().find(|&at| text.is_char_boundary(at)).unwrap_or_default();
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        refused(Span::new(at, at), format!("this is no JSON: {message}"))
    })?;
    let task = document.get("id").and_then(Value::as_str).map_or("p".to_owned(), |id| format!("{}.", word(id)));
    let listed = document.get("properties_to_be_validated").unwrap_or(&document);
    let list: Vec<&Value> = match listed {
        Value::Array(list) => list.iter().collect(),
        one => vec![one],
    };
    let property = |(position, value): (usize, &Value)| -> Result<Property, Diagnostic> {
        let name = format!("{task}{}", position + 1);
        let sentence = value.get("property_description").and_then(Value::as_str).map(one_line);
        let asked = value.get("property").unwrap_or(value).as_object().and_then(asked).ok_or_else(|| {
            refused(Span::default(), format!("property {} of this file is none that can be read", position + 1))
        })?;
        Ok(Property { name, sentence: sentence.filter(|sentence| !sentence.is_empty()), asked })
    };
    list.into_iter().enumerate().map(property).collect()
}

fn asked(property: &Map<String, Value>) -> Option<Asked> {
    match property.get("job_req")?.as_str()? {
        "assertion" => Some(Asked::Assertions),
        "pattern" => {
            let pattern = property.get("pattern_id")?.as_str()?;
            // Parameters are numbered from 0 by some authors and from 1 by others.
            let given = property.get("pattern_params")?.as_object()?;
            let mut parameters: Vec<(u32, &str)> = Vec::new();
            for (place, parameter) in given {
                // A brace would end the group that the parameter is put into.
                let parameter = parameter.as_str().filter(|parameter| !parameter.contains(['{', '}']))?;
                parameters.push((place.parse().ok()?, parameter));
            }
            parameters.sort_unstable();
            let all: Vec<String> = parameters.iter().map(|(_, parameter)| set_off(parameter)).collect();
            let described = property.get("pattern_description").and_then(Value::as_str).map(one_line);
            let described = described.map(|sentence| {
                parameters.iter().fold(sentence, |sentence, (place, parameter)| {
                    sentence.replace(&format!("{{{place}}}"), &set_off(parameter))
                })
            });
            Some(Asked::Pattern { short: format!("{}({})", word(pattern), all.join(", ")), described })
        }
        _ => None,
    }
}

/// Puts a parameter in braces, so that no part of it interacts with its context; a duration stays as it is.
fn set_off(parameter: &str) -> String {
    let text = one_line(parameter);
    let is_duration = text.starts_with("T#") || text.ends_with('s') && text.starts_with(|c: char| c.is_ascii_digit());
    if is_duration { text } else { format!("{{{text}}}") }
}

fn word(text: &str) -> String {
    text.chars().filter(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_')).collect()
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace(char::is_control, "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_and_assertions_are_read() {
        let text = r#"{ "id": "v1 E", "properties_to_be_validated": [
            { "property_description": "all of\nthem", "property": { "job_req": "assertion" } },
            { "property": { "job_req": "pattern", "pattern_id": "pattern-implication", "pattern_params": { "1": "b", "0": "a = 1" },
                "pattern_description": "If {0} is true, {1}." } } ] }"#;
        let found = properties(text).unwrap_or_default();
        assert_eq!(found[0].sentence.as_deref(), Some("all of them"));
        assert_eq!(found[0].asked, Asked::Assertions);
        let described = Some("If {a = 1} is true, {b}.".to_owned());
        assert_eq!(found[1].asked, Asked::Pattern { short: "pattern-implication({a = 1}, {b})".to_owned(), described });
        assert_eq!(found[1].name, "v1E.2");
    }

    const BRACES: &str =
        r#"{ "job_req": "pattern", "pattern_id": "pattern-implication", "pattern_params": { "1": "a}, {b" } }"#;

    #[test]
    fn what_is_none_is_refused() {
        for text in [
            "",
            "{",
            "[1]",
            "{}",
            "{\"job_req\": \"pattern\"}",
            "{\"job_req\": \"magic\"}",
            BRACES,
            "[{\"a\": \u{e9}}]",
        ] {
            assert!(properties(text).is_err(), "{text}");
        }
    }
}
