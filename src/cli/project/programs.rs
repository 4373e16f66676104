//! Programs of a project entry: one, or all matched by patterns.

use std::collections::BTreeSet;
use std::path::Path;

use petril::diagnostic::{Code, Diagnostic};
use petril::source::Span;

use crate::cli::console::Console;
use crate::cli::seen::matching;

/// Programs of an entry, with their positions.
#[derive(Default)]
pub struct Programs {
    /// Value of `program`.
    pub one: Option<(String, Span)>,
    /// Value of `programs`.
    pub patterns: Option<(Vec<String>, Span)>,
}

/// The programs, relative to the folder of the project file, with their names in the summary.
pub fn matches(
    folder: &Path,
    place: Span,
    name: Option<String>,
    programs: Programs,
    console: &Console,
) -> Result<Vec<(String, String)>, Diagnostic> {
    let wrong =
        |span, message: String, help: &str| Err(Diagnostic::new(Code::ProjectProgram, span, message).help(help));
    match programs {
        Programs { one: Some((program, _)), patterns: None } => {
            Ok(vec![(name.unwrap_or_else(|| without_ending(&program)), program)])
        }
        Programs { one: None, patterns: Some((patterns, span)) } => {
            if name.is_some() {
                let message = "a name is for one program, and `programs` may be many".to_owned();
                return wrong(span, message, "leave `name` out: each is called like its file");
            }
            let mut found = Vec::new();
            for pattern in patterns {
                match files(folder, &pattern, console) {
                    Ok(files) if files.is_empty() => {
                        let help = "paths begin at the folder of the project file";
                        return wrong(span, format!("`{pattern}` matches no file"), help);
                    }
                    Ok(files) => found.extend(files),
                    Err(reason) => {
                        let help = "`*` stands for any letters, `**` for any folders, `?` for one letter";
                        return wrong(span, format!("`{pattern}` is no pattern: {reason}"), help);
                    }
                }
            }
            // Several patterns may match the same file.
            let mut seen = BTreeSet::new();
            found.retain(|program| seen.insert(program.clone()));
            Ok(found.into_iter().map(|program| (without_ending(&program), program)).collect())
        }
        Programs { one: Some(_), patterns: Some((_, span)) } => {
            wrong(span, "this entry has `program` and `programs`".to_owned(), "leave one of them out")
        }
        Programs { one: None, patterns: None } => wrong(
            place,
            "this entry has no program".to_owned(),
            "name one: `program = \"press.il\"`, or several: `programs = \"lines/*.il\"`",
        ),
    }
}

fn without_ending(path: &str) -> String {
    Path::new(path).with_extension("").display().to_string()
}

/// Files matched by a pattern, relative to the folder, sorted by name.
fn files(folder: &Path, pattern: &str, console: &Console) -> Result<Vec<String>, String> {
    let whole = Path::new(&glob::Pattern::escape(&folder.display().to_string())).join(pattern).display().to_string();
    glob::Pattern::new(&whole).map_err(|error| error.msg.to_owned())?;
    let files = matching(&whole);
    console.has_matched(&whole, &files);
    Ok(files.iter().map(|path| path.strip_prefix(folder).unwrap_or(path).display().to_string()).collect())
}
