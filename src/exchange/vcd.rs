//! Runs as value change dumps (VCD, IEEE 1364-2005, clause 18), which every waveform viewer reads.
//!
//! A variable has its initial value at time 0, and its value at the end of each scan from then on. Time is in
//! milliseconds; scans are one scan cycle of the program apart. Members of an instance or a structure form a scope.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use petril_base::printable;
use petril_check::translate::System;
use petril_check::witness::{Scan, ScanTrace};
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Kind, Role, VarId};

/// Writes a trace with all declared variables, under a title. Unknown values, after a scan that never ends, are `x`.
#[must_use]
pub fn write(system: &System, trace: &ScanTrace, title: &str) -> String {
    let program = &system.program;
    let mut remarks = vec![title.to_owned()];
    for (position, scan) in trace.scans.iter().enumerate() {
        let done = scan.done(system);
        remarks.extend((!done.is_empty()).then(|| format!("before scan {}: {done}", position + 1)));
    }
    if let Some(start) = trace.loop_start {
        let (last, first) = (trace.scans.len(), start + 1);
        remarks.push(format!("and so on for ever: scan {last} ends in the state in which scan {first} ended"));
    }
    let rows = trace.scans.iter().map(|scan| program.declared().map(|id| value(program, scan, id)).collect());
    write_rows(program, &remarks, rows)
}

/// Value of a variable at the end of a scan, if known.
fn value(program: &FlatProgram, scan: &Scan, id: VarId) -> Option<u64> {
    match &scan.end {
        Some(end) => Some(end.memory[id.0]),
        None if program.variable(id).role == Role::Input => {
            scan.inputs.iter().find(|&&(input, _)| input == id).map(|&(_, value)| value)
        }
        None => None,
    }
}

/// Writes one row per scan: values of the declared variables at its end, in their order, as bit patterns; `None` if not
/// known.
pub fn write_rows(
    program: &FlatProgram,
    remarks: &[String],
    rows: impl IntoIterator<Item = Vec<Option<u64>>>,
) -> String {
    let mut out = format!("$version petril {} $end\n$timescale 1 ms $end\n", env!("CARGO_PKG_VERSION"));
    for remark in remarks {
        out += &comment(remark);
    }
    out += &comment(&format!("a scan every {} ms", program.cycle));
    let variables: Vec<VarId> = program.declared().collect();
    let mut scope = Scope::new(&program.name);
    variables.iter().enumerate().for_each(|(number, &id)| scope.add(&program.variable(id).name, number));
    scope.declare(program, &variables, &mut out);
    out += "$enddefinitions $end\n#0\n$dumpvars\n";
    let mut shown: Vec<Option<u64>> = variables.iter().map(|&id| Some(program.variable(id).initial)).collect();
    for (number, &id) in variables.iter().enumerate() {
        change(program, id, number, shown[number], &mut out);
    }
    out += "$end\n";
    for (scan, row) in rows.into_iter().enumerate() {
        let _ = writeln!(out, "#{}", (scan as u64 + 1).saturating_mul(program.cycle));
        for (number, (&id, value)) in variables.iter().zip(row).enumerate() {
            if std::mem::replace(&mut shown[number], value) != value {
                change(program, id, number, value, &mut out);
            }
        }
    }
    out
}

/// A comment of one line; the text cannot end it early.
fn comment(text: &str) -> String {
    let words: Vec<String> = text.split_whitespace().map(|word| word.replace("$end", "$ end")).collect();
    format!("$comment {} $end\n", printable::line(&words.join(" ")))
}

/// Line that assigns a value to a variable.
fn change(program: &FlatProgram, id: VarId, number: usize, value: Option<u64>, out: &mut String) {
    let code = code(number);
    let _ = match (program.variable(id).ty.is_bool(), value) {
        (true, Some(bit)) => writeln!(out, "{bit}{code}"),
        (true, None) => writeln!(out, "x{code}"),
        (false, Some(pattern)) => writeln!(out, "b{pattern:b} {code}"),
        (false, None) => writeln!(out, "bx {code}"),
    };
}

/// Short identifier of a variable: a number in digits from `!` to `~`, the lowest first; `!` is 0, and `!!` follows
/// `~`.
fn code(mut number: usize) -> String {
    let mut code = String::new();
    loop {
        code.push(char::from(b'!' + (number % 94) as u8));
        if number < 94 {
            return code;
        }
        number = number / 94 - 1;
    }
}

/// A name as a VCD identifier. Names that are not simple, like `level[3]`, begin with `\` and end with a space.
fn identifier(name: &str) -> String {
    let is_simple = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if is_simple { name.to_owned() } else { format!("\\{name}") }
}

/// Scope: the program, an instance or a structure.
struct Scope {
    name: String,
    /// Variables, each with its position among all.
    variables: Vec<(String, usize)>,
    scopes: Vec<Scope>,
    /// Position of each inner scope by name.
    known: BTreeMap<String, usize>,
}

impl Scope {
    fn new(name: &str) -> Self {
        Self { name: name.to_owned(), variables: Vec::new(), scopes: Vec::new(), known: BTreeMap::new() }
    }

    /// Adds a variable in the scope given by its name: `pump.T.Q` is `Q` in `T` in `pump`.
    fn add(&mut self, name: &str, number: usize) {
        let Some((scope, rest)) = name.split_once('.') else {
            self.variables.push((name.to_owned(), number));
            return;
        };
        let position = *self.known.entry(scope.to_owned()).or_insert(self.scopes.len());
        if position == self.scopes.len() {
            self.scopes.push(Self::new(scope));
        }
        self.scopes[position].add(rest, number);
    }

    fn declare(&self, program: &FlatProgram, variables: &[VarId], out: &mut String) {
        let _ = writeln!(out, "$scope module {} $end", identifier(&self.name));
        for (name, number) in &self.variables {
            let ty = program.variable(variables[*number]).ty;
            let kind = match ty.kind {
                Kind::Bits if ty.is_bool() => "wire",
                Kind::Bits => "reg",
                Kind::Signed | Kind::Unsigned | Kind::Time => "integer",
            };
            let _ = writeln!(out, "$var {kind} {} {} {} $end", ty.width, code(*number), identifier(name));
        }
        self.scopes.iter().for_each(|scope| scope.declare(program, variables, out));
        *out += "$upscope $end\n";
    }
}
