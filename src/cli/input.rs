//! Input files: programs, plants, nets.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use petril::diagnostic::{Code, Diagnostic, any_error};
use petril::exchange::{pnml, tina};
use petril::flat::{FlatProgram, flatten_with};
use petril::net::Located;
use petril::semantics;
use petril::source::{NotText, Source, Span};
use petril::syntax;
use petril::translate::{Plant, System};

use super::console::Console;
use super::meaning::Reading;
use super::{Failure, output, phase, reason, shown};

/// Upper bounds on input files in bytes: programs and requirements are written by hand, nets may be generated.
pub const MAX_TEXT: u64 = 64 << 20;
const MAX_NET: u64 = 2 << 30;

/// Reads a file as text. `-` is standard input.
pub fn source(path: &Path, limit: u64, console: &Console) -> Result<Source, Failure> {
    let name = path.display().to_string();
    let cannot = |error: std::io::Error| {
        console.has_read(path, None);
        Failure::Message(format!("cannot read `{}`: {}", shown(path), reason(&error)))
    };
    let mut bytes = Vec::new();
    phase::begin("reading files");
    if name == "-" {
        output::has_read(path);
        std::io::stdin().take(limit + 1).read_to_end(&mut bytes).map_err(cannot)?;
        console.has_read(path, Some(&bytes));
    } else {
        // A `File` rather than a trait object: its size is known, so the bytes are read into place at once.
        File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)).map_err(cannot)?;
        console.has_read(path, Some(&bytes));
    }
    let refuse = |code, span, message: String, help: &str, bytes: &[u8]| {
        let source = Source::new(name.clone(), String::from_utf8_lossy(bytes).into_owned());
        console.diagnostics(&[Diagnostic::new(code, span, message).help(help)], &source);
        Failure::Reported
    };
    if bytes.len() as u64 > limit {
        let message = format!("this file has more than {} MiB", limit >> 20);
        return Err(refuse(Code::FileTooLarge, Span::default(), message, "is it the right file?", b""));
    }
    Source::decode(name.clone(), bytes).map_err(|NotText { offset, bytes }| {
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

/// Program that passed all checks, with its text.
pub struct Program {
    pub flat: FlatProgram,
    pub source: Source,
}

/// Reads a program, or the requested unit. Its diagnostics are printed, warnings included.
pub fn program(path: &Path, reading: &Reading, console: &Console) -> Result<Program, Failure> {
    program_of(source(path, MAX_TEXT, console)?, reading, console)
}

/// As [`program`], for a text already read.
pub fn program_of(source: Source, reading: &Reading, console: &Console) -> Result<Program, Failure> {
    phase::begin("reading the program");
    let (unit, mut diagnostics) = syntax::parse(&source);
    if reading.strict {
        diagnostics.extend(semantics::strict(&source, &unit));
    }
    phase::begin("checking names and types");
    let (program, more) = semantics::check_unit(&unit, !any_error(&diagnostics), reading.pou.as_deref());
    // Strict mode has reported this already.
    diagnostics.extend(more.into_iter().filter(|d| !(reading.strict && d.code == Code::CheckedByItself)));
    diagnostics.sort_by_key(Diagnostic::span);
    console.diagnostics(&diagnostics, &source);
    let program = program.filter(|_| !any_error(&diagnostics)).ok_or(Failure::Reported)?;
    phase::begin("flattening the program");
    Ok(Program { flat: flatten_with(&program, reading.scan_time), source })
}

/// Assumption that a warning about a program implies, in words.
pub fn assumed(code: &str, message: &str) -> Option<String> {
    (code == Code::AddressesMayOverlap.id()).then(|| format!("every address is a place of its own, though {message}"))
}

/// Reader of nets.
type NetReader = fn(&Source) -> Result<Located, Vec<Diagnostic>>;

/// Reads a net, in the format of its file extension.
pub fn net(path: &Path, console: &Console) -> Result<(Located, Source), Failure> {
    net_by(path, [tina::read, pnml::read], console)
}

/// Reads a net that may be safe.
pub fn safe_net(path: &Path, console: &Console) -> Result<(Located, Source), Failure> {
    net_by(path, [tina::read_safe, pnml::read_safe], console)
}

fn net_by(path: &Path, [of_tina, of_pnml]: [NetReader; 2], console: &Console) -> Result<(Located, Source), Failure> {
    let read = match path.extension().and_then(OsStr::to_str) {
        Some("net") => of_tina,
        Some("pnml") => of_pnml,
        _ => {
            let message = format!("`{}` is no net that can be read: its name must end with .net or .pnml", shown(path));
            return Err(Failure::Message(message));
        }
    };
    let source = source(path, MAX_NET, console)?;
    phase::begin("reading a net");
    match read(&source) {
        Ok(net) => {
            console.diagnostics(&net.warnings, &source);
            Ok((net, source))
        }
        Err(diagnostics) => {
            console.diagnostics(&diagnostics, &source);
            Err(Failure::Reported)
        }
    }
}

/// Reads a program and its plants as a system; free inputs take any value.
pub fn system<P: AsRef<Path>>(
    path: &Path,
    plants: &[P],
    reading: &Reading,
    console: &Console,
) -> Result<(System, Source), Failure> {
    let (program, plant) = parts(path, plants, reading, console)?;
    phase::begin("composing the net");
    Ok((System::new(program.flat, plant), program.source))
}

/// Reads a program and its plants.
pub fn parts<P: AsRef<Path>>(
    path: &Path,
    plants: &[P],
    reading: &Reading,
    console: &Console,
) -> Result<(Program, Plant), Failure> {
    parts_of(source(path, MAX_TEXT, console)?, plants, reading, console)
}

/// As [`parts`], for a program text already read.
pub fn parts_of<P: AsRef<Path>>(
    source: Source,
    plants: &[P],
    reading: &Reading,
    console: &Console,
) -> Result<(Program, Plant), Failure> {
    let program = program_of(source, reading, console);
    // All files are read before giving up, so that all errors are seen at once.
    let nets: Vec<_> = plants.iter().map(|plant| safe_net(plant.as_ref(), console)).collect();
    let program = program?;
    let mut plant = Plant::default();
    let mut failed = false;
    for net in nets {
        let (net, net_source) = net?;
        let (Ok(diagnostics) | Err(diagnostics)) = plant.add(&net, &program.flat);
        console.diagnostics(&diagnostics, &net_source);
        failed |= any_error(&diagnostics);
    }
    if failed { Err(Failure::Reported) } else { Ok((program, plant)) }
}
