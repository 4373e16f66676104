//! `petril sif prove`: conformance of a program to its specification.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use petril::exchange::proof as exchanged;
use petril::printable::line;
use petril::semantics::Role;
use petril::sif::proof::{Answer, By, Confirmed, Failure, Form, Options, Outcome, Proof, Scan, Subject, prove};
use petril::sif::{Kind, SignalId};
use petril::source::Source;
use petril::verdict::Verdict;
use petril::witness::{Column, Table};

use super::args::SifProve;
use super::{planned, specification, unbound};
use crate::cli::console::{Colour, Console};
use crate::cli::report::{counted, indent};
use crate::cli::{self, check, guard, input, phase};

pub fn run(arguments: &SifProve, console: &Console) -> cli::Outcome {
    let (program, specifications) = split(&arguments.files)?;
    let read = specification(specifications, console);
    // Both are read before either error is returned, so that all errors are reported at once.
    let program = input::program(program, &arguments.meaning.reading, console)?;
    let read = read?;
    let functions = planned::functions(&arguments.function, &read.specification)?;
    let tolerated = arguments.meaning.tolerated();
    let subject = Subject::new(&read.specification, &program.flat, tolerated, &functions)
        .map_err(|found| unbound(&found, &read.sources, console))?;
    phase::begin_asking("proving");
    let options = Options { scans: arguments.scans.into(), stop: Arc::new(guard::is_asked), ..Options::default() };
    let mut proof = prove(&subject, &options);
    let warnings = console.warnings();
    proof.assumptions.extend(warnings.iter().filter_map(|(code, _, message)| input::assumed(code, message)));
    let told = Told { subject: &subject, source: &program.source, sources: &read.sources, proof: &proof, console };
    if arguments.json {
        console.print_json(exchanged::proof(&subject, &proof, &program.source))?;
    } else {
        console.print_report(&told.text(), &console.provenance(), false)?;
    }
    Ok(code(&proof))
}

fn code(proof: &Proof) -> ExitCode {
    check::code(proof.verdict())
}

/// Splits the arguments into the program, which comes last, and the specifications.
fn split(files: &[PathBuf]) -> Result<(&PathBuf, &[PathBuf]), cli::Failure> {
    let is_specification = |path: &PathBuf| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("sif"));
    match files.split_last() {
        Some((program, specifications)) if !is_specification(program) => Ok((program, specifications)),
        _ => Err(cli::Failure::Message("the last file has to be the program, after the specification".to_owned())),
    }
}

/// Text report of a proof.
struct Told<'a> {
    subject: &'a Subject<'a>,
    source: &'a Source,
    sources: &'a [Source],
    proof: &'a Proof,
    console: &'a Console,
}

impl Told<'_> {
    fn text(&self) -> String {
        let program = self.subject.program;
        let from: Vec<String> = self.sources.iter().map(|source| line(source.name())).collect();
        let mut out =
            format!("program `{}` from {}, against {}\n\n", program.name, line(self.source.name()), from.join(", "));
        let longest = |text: &dyn Fn(&Answer) -> String| {
            self.proof.answers.iter().map(|answer| text(answer).chars().count()).max().unwrap_or(0)
        };
        let name = |answer: &Answer| self.subject.specification.name(answer.claim.signal).to_owned();
        let width = longest(&name);
        for answer in &self.proof.answers {
            let word = word(answer.outcome.verdict());
            let painted = self.painted(answer.outcome.verdict());
            let gap = " ".repeat("refuted".len() - word.len());
            out += &format!("{:width$}  {painted}{gap}  {}\n", name(answer), how(answer));
        }
        for answer in &self.proof.answers {
            if let Outcome::Refuted(scans) = &answer.outcome {
                out += &self.difference(answer, scans);
            }
        }
        for (failure, scans) in &self.proof.failures {
            let last = scans.len();
            out += &format!("\n{}: {} in scan {last}\n", self.painted(Verdict::Violated), self.failure(*failure));
            out += &indent(&self.table(scans, &self.all_inputs(), None));
        }
        for (failure, reason) in &self.proof.unknown_failures {
            let what = failure.map_or("whether every scan ends without an error".to_owned(), |f| self.failure(f));
            out += &format!("\n{}: {what}: {reason}\n", self.painted(Verdict::Unknown));
        }
        out += "\n";
        for (head, list) in [("assumed", &self.proof.assumptions), ("note", &self.proof.remarks)] {
            list.iter().for_each(|text| out += &format!("{head}: {}\n", line(text)));
        }
        if self.proof.compared > 0 {
            let scans = counted(self.proof.compared, "scan");
            out += &format!("compared: gates and interpreter agree in {scans} by chance\n");
        }
        let count = |verdict| self.proof.answers.iter().filter(|answer| answer.outcome.verdict() == verdict).count();
        let [proved, refuted, unknown] = [Verdict::Holds, Verdict::Violated, Verdict::Unknown].map(count);
        out + &format!(
            "{}: {proved} proved, {refuted} refuted, {unknown} unknown\n",
            counted(self.proof.answers.len(), "output")
        )
    }

    fn painted(&self, verdict: Verdict) -> String {
        let colour = match verdict {
            Verdict::Holds => Colour::Good,
            Verdict::Violated => Colour::Bad,
            Verdict::Unknown => Colour::Doubtful,
        };
        self.console.paint(word(verdict), colour)
    }

    /// Counterexample whose last scan shows an output that differs from its specification.
    fn difference(&self, answer: &Answer, scans: &[Scan]) -> String {
        let Some(last) = scans.last() else { return String::new() };
        let (specification, claim) = (self.subject.specification, &answer.claim);
        let variable = &self.subject.program.variable(claim.variable).name;
        let is = truth(last.memory[claim.variable.0] == 1);
        let Kind::Defined { formula, latched, delayed, .. } = &specification.signal(claim.signal).kind else {
            return String::new();
        };
        let name = specification.name(claim.signal);
        let mut head = format!("{name} = {}", specification.text(formula));
        if let Some(reset) = latched {
            head += &format!(", latched until {}", specification.text(reset));
        }
        if let Some(delay) = delayed {
            head += &format!(", delayed T#{delay}ms");
        }
        let wanted = last.wanted[claim.signal.0];
        let has_to = match claim.form {
            Form::Equal | Form::Latched => format!("`{name}` has to be {}", truth(wanted)),
            Form::NotWithout => format!("`{name}` cannot be TRUE"),
        };
        let scan = scans.len();
        let mut out = format!("\n{}: {head}\n", self.painted(Verdict::Violated));
        out += &indent(&format!("after scan {scan}, `{variable}` is {is}, but {has_to}\n\n"));
        let inputs = self.subject.inputs_of(claim.signal);
        out + &indent(&self.table(scans, &inputs, Some(answer)))
    }

    fn all_inputs(&self) -> Vec<SignalId> {
        self.subject.inputs().map(|(id, _)| id).collect()
    }

    /// Trace in terms of signals and variables: a row per input and output, a column per scan.
    fn table(&self, scans: &[Scan], inputs: &[SignalId], about: Option<&Answer>) -> String {
        let (subject, program) = (self.subject, self.subject.program);
        let columns = (1..=scans.len()).map(|scan| Column::right(format!("scan {scan}"))).collect();
        let mut table = Table::new(vec![vec![Column::left("signal"), Column::left("variable")], columns]);
        let mut row = |signal: &str, variable: &str, value: &dyn Fn(&Scan) -> String| {
            let cells = [signal.to_owned(), variable.to_owned()];
            table.row(&cells.into_iter().chain(scans.iter().map(value)).collect::<Vec<_>>());
        };
        let bit = |value: bool| u8::from(value).to_string();
        for (id, variable) in subject.inputs() {
            let rest = subject.specification.rest(id);
            if inputs.contains(&id) || scans.iter().any(|scan| scan.signals[id.0] != rest) {
                let name = subject.specification.name(id);
                row(name, &program.variable(variable).name, &|scan| bit(scan.signals[id.0]));
            }
        }
        for &id in &subject.outside {
            if inputs.contains(&id) || scans.iter().any(|scan| scan.signals[id.0] != subject.specification.rest(id)) {
                row(subject.specification.name(id), "", &|scan| bit(scan.signals[id.0]));
            }
        }
        let named: Vec<_> = subject.inputs().map(|(_, variable)| variable).collect();
        for input in program.with_role(Role::Input).filter(|input| !named.contains(input)) {
            let declared = program.variable(input);
            let value = |scan: &Scan| scan.memory[input.0];
            if scans.iter().any(|scan| value(scan) != declared.initial) {
                row("", &declared.name, &|scan| program.value_text(input, value(scan)));
            }
        }
        if let Some(Answer { claim, .. }) = about {
            let (name, variable) = (subject.specification.name(claim.signal), &program.variable(claim.variable).name);
            row(name, "as specified", &|scan| bit(scan.wanted[claim.signal.0]));
            row("", variable, &|scan| scan.memory[claim.variable.0].to_string());
        }
        table.within(self.console.output_width().saturating_sub(4).max(40))
    }

    fn failure(&self, failure: Failure) -> String {
        match failure {
            Failure::Hazard(at, hazard) => {
                let span = self.subject.program.code[at].span;
                let (row, column) = self.source.line_column(span.start);
                format!("{hazard} at {}:{row}:{column}", line(self.source.name()))
            }
            Failure::Endless => "a scan that never ends".to_owned(),
            Failure::TooLong => "a scan that takes too long to wait for its end".to_owned(),
        }
    }
}

/// Proof method or length of the counterexample.
fn how(answer: &Answer) -> String {
    match &answer.outcome {
        Outcome::Proved { by, confirmed } => {
            let by = match by {
                By::AnyState => "for every scan, whatever it begins with".to_owned(),
                By::Induction(scans) => format!("by induction over {}", counted(*scans, "scan")),
                By::EveryScan => "by computing every scan from every state".to_owned(),
            };
            let confirmed = match confirmed {
                Some(Confirmed::EveryScan { states, scans }) => {
                    let (scans, states) = (counted(*scans as usize, "scan"), counted(*states as usize, "state"));
                    format!("; the interpreter agrees, in {scans} from {states}")
                }
                Some(Confirmed::Diagrams) => "; decision diagrams agree".to_owned(),
                None => String::new(),
            };
            let form = match answer.claim.form {
                Form::Equal => "",
                Form::Latched => "with its latch, ",
                Form::NotWithout => "that it never comes without its formula, ",
            };
            format!("{form}{by}{confirmed}")
        }
        Outcome::Refuted(scans) => format!("after {}", counted(scans.len(), "scan")),
        Outcome::Unknown(reason) => reason.clone(),
    }
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "proved",
        Verdict::Violated => "refuted",
        Verdict::Unknown => "unknown",
    }
}

fn truth(value: bool) -> &'static str {
    if value { "TRUE" } else { "FALSE" }
}
