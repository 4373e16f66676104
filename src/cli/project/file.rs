//! Project files: `petril.toml` lists the programs to check, with their plants and requirements.

use std::path::{Path, PathBuf};

use petril::diagnostic::{Code, Diagnostic};
use petril::source::{Source, Span};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::{KEYS, Setting, span, texts};
use super::programs::{Programs, matches};
use crate::cli::console::Console;
use crate::cli::{Failure, input};

/// Name of project files.
pub const NAME: &str = "petril.toml";

/// Finds the project file of the current folder, or of the nearest one above it.
pub fn find() -> Option<PathBuf> {
    let mut path = PathBuf::from(NAME);
    let here = std::env::current_dir().ok()?;
    here.ancestors().find_map(|_| {
        let found = path.is_file().then(|| path.clone());
        path = Path::new("..").join(&path);
        found
    })
}

/// Program to check, with its options.
pub struct Entry {
    /// Unique name in the summary.
    pub name: String,
    /// Options of `petril check`.
    pub options: Vec<String>,
    /// Path of the program.
    pub program: PathBuf,
}

/// Reads a project file. All its errors are printed at once.
pub fn read(path: &Path, console: &Console) -> Result<Vec<Entry>, Failure> {
    let source = input::source(path, input::MAX_TEXT, console)?;
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let mut reader = Reader { console, folder, entries: Vec::new(), diagnostics: Vec::new() };
    reader.document(&source);
    let Reader { entries, mut diagnostics, .. } = reader;
    diagnostics.sort_by_key(Diagnostic::span);
    console.diagnostics(&diagnostics, &source);
    if diagnostics.is_empty() { Ok(entries) } else { Err(Failure::Reported) }
}

struct Reader<'c> {
    console: &'c Console,
    folder: PathBuf,
    entries: Vec<Entry>,
    diagnostics: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn document(&mut self, source: &Source) {
        let (document, errors) = DeTable::parse_recoverable(source.text());
        if !errors.is_empty() {
            // Recovered content may differ from what is meant.
            self.diagnostics.extend(errors.iter().map(|error| {
                let span = error.span().unwrap_or_default();
                Diagnostic::new(Code::ProjectSyntax, Span::new(span.start, span.end), error.message())
            }));
            return;
        }
        let mut defaults = Vec::new();
        let mut checks = Vec::new();
        for (key, value) in document.get_ref() {
            match (key.get_ref().as_ref(), value.get_ref()) {
                ("defaults", DeValue::Table(table)) => {
                    for (key, value) in table {
                        self.setting(key, value, &[], &mut defaults);
                    }
                }
                ("check", DeValue::Array(values)) => checks = values.iter().collect(),
                ("defaults", _) => {
                    self.wrong(value, "`defaults` is a table", "write `[defaults]` on a line of its own");
                }
                ("check", _) => self.wrong(
                    value,
                    "`check` is a list of tables",
                    "write `[[check]]`, with two brackets, above each program's lines",
                ),
                _ => self.unknown(key, "here", ["defaults", "check"]),
            }
        }
        for check in checks {
            match check.get_ref() {
                DeValue::Table(table) => self.check(span(check), table, &defaults),
                _ => self.wrong(check, "`check` is a list of tables", "write `[[check]]` above each program's lines"),
            }
        }
        if self.entries.is_empty() && self.diagnostics.is_empty() {
            let diagnostic = Diagnostic::new(Code::ProjectProgram, Span::default(), "this project has no program");
            self.diagnostics
                .push(diagnostic.help("begin a part with `[[check]]`, and name one: `program = \"press.il\"`"));
        }
    }

    /// Reads one `[[check]]`.
    fn check(&mut self, place: Span, table: &DeTable<'_>, defaults: &[Setting]) {
        let (mut name, mut programs, mut settings) = (None, Programs::default(), Vec::new());
        let errors = self.diagnostics.len();
        for (key, value) in table {
            match key.get_ref().as_ref() {
                "name" => match value.get_ref().as_str() {
                    Some(text) => name = Some(text.to_owned()),
                    None => self.wrong(value, "`name` takes a text", "write it like `name = \"press\"`"),
                },
                "program" => match value.get_ref().as_str() {
                    Some(text) => programs.one = Some((text.to_owned(), span(value))),
                    None => self.wrong(value, "`program` takes one text", "several are `programs = [\"lines/*.il\"]`"),
                },
                "programs" => match texts("programs", value) {
                    Ok(patterns) => programs.patterns = Some((patterns, span(value))),
                    Err(wrong) => self.diagnostics.extend(wrong),
                },
                _ => self.setting(key, value, &["name", "program", "programs"], &mut settings),
            }
        }
        if self.diagnostics.len() > errors {
            return;
        }
        let is_named = name.is_some();
        match matches(&self.folder, place, name, programs, self.console) {
            Ok(found) => {
                let kept = defaults.iter().filter(|default| !settings.iter().any(|setting| setting.replaces(default)));
                let settings: Vec<Setting> = kept.chain(&settings).cloned().collect();
                for (name, program) in found {
                    self.entry(place, name, is_named, &program, &settings);
                }
            }
            Err(diagnostic) => self.diagnostics.push(diagnostic),
        }
    }

    fn entry(&mut self, place: Span, name: String, is_named: bool, program: &str, settings: &[Setting]) {
        if self.entries.iter().any(|entry| entry.name == name) {
            let message = format!("a check named `{name}` was given already");
            let help =
                if is_named { "give each a name of its own" } else { "give one of them a name: `name = \"…\"`" };
            self.diagnostics.push(Diagnostic::new(Code::ProjectName, place, message).help(help));
            return;
        }
        let stem = Path::new(program).with_extension("").display().to_string();
        let base = Path::new(&stem).file_name().map(|base| base.to_string_lossy().into_owned()).unwrap_or_default();
        let path =
            |text: &str| self.folder.join(text.replace("{stem}", &stem).replace("{name}", &base)).display().to_string();
        let options = settings.iter().flat_map(|setting| setting.arguments(&path)).collect();
        self.entries.push(Entry { name, options, program: self.folder.join(program) });
    }

    fn setting(
        &mut self,
        key: &Spanned<std::borrow::Cow<'_, str>>,
        value: &Spanned<DeValue<'_>>,
        others: &[&'static str],
        settings: &mut Vec<Setting>,
    ) {
        match KEYS.iter().find(|known| known.name == key.get_ref()) {
            Some(known) => match Setting::read(known, value) {
                Ok(setting) => settings.push(setting),
                Err(wrong) => self.diagnostics.extend(wrong),
            },
            None => {
                let place = if others.is_empty() { "in `[defaults]`" } else { "in `[[check]]`" };
                self.unknown(key, place, KEYS.iter().map(|key| key.name).chain(others.iter().copied()));
            }
        }
    }

    fn unknown<'k>(
        &mut self,
        key: &Spanned<std::borrow::Cow<'_, str>>,
        place: &str,
        known: impl IntoIterator<Item = &'k str>,
    ) {
        let known: Vec<&str> = known.into_iter().collect();
        let message = format!("the key `{}` means nothing {place}", key.get_ref());
        let diagnostic = Diagnostic::new(Code::ProjectKey, span(key), message);
        let suggested = diagnostic.clone().suggest_at(self.diagnostics.len(), key.get_ref(), known.iter().copied());
        self.diagnostics.push(match suggested.help.is_empty() {
            true => diagnostic.help(format!("there are {}", known.join(", "))),
            false => suggested,
        });
    }

    fn wrong(&mut self, value: &Spanned<DeValue<'_>>, message: &str, help: &str) {
        self.diagnostics.push(Diagnostic::new(Code::ProjectValue, span(value), message).help(help));
    }
}
