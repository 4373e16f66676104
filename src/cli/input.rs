//! Files in: programs, plants, requirements.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use petril::diagnostic::{Code, Diagnostic, any_error};
use petril::exchange::{pnml, tina};
use petril::flat::{FlatProgram, flatten};
use petril::logic::{Bound, Requirement, View, bind, parse_formula, parse_requirements};
use petril::net::Located;
use petril::semantics;
use petril::source::{NotText, Source, Span};
use petril::syntax;
use petril::translate::{Plant, System};

use super::console::{Console, MAX_DIAGNOSTICS};
use super::{Failure, reason};

/// Programs and requirements are written by hand; nets may come from a generator.
const MAX_TEXT: u64 = 64 << 20;
const MAX_NET: u64 = 2 << 30;

/// Reads a file as text. `-` is standard input.
pub fn source(path: &Path, limit: u64, console: &Console) -> Result<Source, Failure> {
    let name = path.display().to_string();
    let cannot = |error: std::io::Error| Failure::Message(format!("cannot read `{name}`: {}", reason(&error)));
    let mut bytes = Vec::new();
    let mut reader: Box<dyn Read> =
        if name == "-" { Box::new(std::io::stdin()) } else { Box::new(File::open(path).map_err(cannot)?) };
    reader.by_ref().take(limit + 1).read_to_end(&mut bytes).map_err(cannot)?;
    let refuse = |code, span, message: String, help: &str, bytes: &[u8]| {
        let source = Source::new(name.clone(), String::from_utf8_lossy(bytes).into_owned());
        console.diagnostics(&[Diagnostic::new(code, span, message).help(help)], &source);
        Failure::Reported
    };
    if bytes.len() as u64 > limit {
        let message = format!("this file has more than {} MiB", limit >> 20);
        return Err(refuse(Code::FileTooLarge, Span::default(), message, "is it the right file?", b""));
    }
    Source::decode(name.clone(), &bytes).map_err(|NotText { offset }| {
        let utf_16 = bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF");
        let (message, help) = if utf_16 {
            ("this file is written in UTF-16".to_owned(), "save it as UTF-8")
        } else {
            let message = format!("this file is no text: byte {} is NUL", offset + 1);
            (message, "save it as plain text, in UTF-8 or ISO 8859-1")
        };
        refuse(Code::NotText, Span::new(offset, offset + 1), message, help, &readable(&bytes[..=offset]))
    })
}

/// Bytes up to a NUL, as text of the same length.
fn readable(bytes: &[u8]) -> Vec<u8> {
    bytes.iter().map(|&b| if b.is_ascii_graphic() || b.is_ascii_whitespace() { b } else { b'.' }).collect()
}

/// A program that passed all checks, with its text.
pub struct Program {
    pub flat: FlatProgram,
    pub source: Source,
}

/// Reads a program, or the unit of this name. Its diagnostics are printed, warnings too.
pub fn program(path: &Path, pou: Option<&str>, console: &Console) -> Result<Program, Failure> {
    let source = source(path, MAX_TEXT, console)?;
    let (unit, mut diagnostics) = syntax::parse(&source);
    let (program, more) = semantics::check_unit(&unit, !any_error(&diagnostics), pou);
    diagnostics.extend(more);
    diagnostics.sort_by_key(Diagnostic::span);
    console.diagnostics(&diagnostics, &source);
    program.map(|program| Program { flat: flatten(&program), source }).ok_or(Failure::Reported)
}

/// Reads a net, by the ending of its name.
pub fn net(path: &Path, console: &Console) -> Result<(Located, Source), Failure> {
    let read = match path.extension().and_then(OsStr::to_str) {
        Some("net") => tina::read,
        Some("pnml") => pnml::read,
        _ => {
            let message =
                format!("`{}` is no net that can be read: its name must end with .net or .pnml", path.display());
            return Err(Failure::Message(message));
        }
    };
    let source = source(path, MAX_NET, console)?;
    match read(&source) {
        Ok(net) => Ok((net, source)),
        Err(diagnostics) => {
            console.diagnostics(&diagnostics, &source);
            Err(Failure::Reported)
        }
    }
}

/// A program in its plants.
pub fn system<P: AsRef<Path>>(
    path: &Path,
    pou: Option<&str>,
    plants: &[P],
    console: &Console,
) -> Result<(System, Source), Failure> {
    let program = program(path, pou, console);
    // Every file is read before anything is given up, so that all errors are seen at once.
    let nets: Vec<_> = plants.iter().map(|plant| net(plant.as_ref(), console)).collect();
    let Program { flat, source } = program?;
    let mut plant = Plant::default();
    let mut failed = false;
    for net in nets {
        let (net, net_source) = net?;
        if let Err(diagnostics) = plant.add(&net, &flat) {
            console.diagnostics(&diagnostics, &net_source);
            failed = true;
        }
    }
    if failed { Err(Failure::Reported) } else { Ok((System::new(flat, plant), source)) }
}

/// Reads the requirement files and formulas, and binds them.
pub fn requirements(
    files: &[impl AsRef<Path>],
    formulas: &[String],
    system: &System,
    view: View,
    console: &Console,
) -> Result<Vec<(Requirement, Bound)>, Failure> {
    let mut failed = false;
    let mut texts = Vec::new();
    for (i, formula) in formulas.iter().enumerate() {
        let source = Source::new(format!("formula r{}", i + 1), formula.as_str());
        texts.push(match parse_formula(&format!("r{}", i + 1), &source) {
            Ok(requirement) => (vec![requirement], vec![], source),
            Err(error) => (vec![], vec![error], source),
        });
    }
    for file in files {
        match source(file.as_ref(), MAX_TEXT, console) {
            Ok(source) => {
                let (requirements, diagnostics) = parse_requirements(&source);
                texts.push((requirements, diagnostics, source));
            }
            Err(Failure::Reported) => failed = true,
            Err(failure) => return Err(failure),
        }
    }
    let mut bound: Vec<(Requirement, Bound)> = Vec::new();
    for (requirements, mut diagnostics, source) in texts {
        let others = bound.len();
        for requirement in requirements {
            if bound[..others].iter().any(|(other, _)| other.name.eq_ignore_ascii_case(&requirement.name)) {
                let message = format!("a requirement named `{}` was given already", requirement.name);
                let help = "give each a name of its own; the formulas of `-r` are named r1, r2, …";
                diagnostics.push(Diagnostic::new(Code::RequirementNameTwice, requirement.span, message).help(help));
            }
            if diagnostics.len() >= MAX_DIAGNOSTICS {
                break;
            }
            match bind(&requirement.formula, system, view) {
                Ok(formula) => bound.push((requirement, formula)),
                Err(errors) => diagnostics.extend(errors),
            }
        }
        diagnostics.sort_by_key(Diagnostic::span);
        console.diagnostics(&diagnostics, &source);
        failed |= any_error(&diagnostics);
    }
    if failed { Err(Failure::Reported) } else { Ok(bound) }
}
