//! What is asked, and what is assumed, from files, from the command line, and from the comments of a program.

use std::path::{Path, PathBuf};

use petril::diagnostic::{Code, Diagnostic, any_error};
use petril::flat::FlatProgram;
use petril::logic::{
    Assertion, Assumption, Demand, FairnessAssumption, FairnessText, Requirement, RequirementFile, View,
    bind_assertion, bind_assumption, bind_domain, bind_fairness, bind_requirement, parse_domain, parse_fairness,
    parse_requirement, parse_requirements,
};
use petril::source::Source;
use petril::syntax;
use petril::translate::{Domains, Plant, System};

use super::Failure;
use super::args::Check;
use super::console::{Console, MAX_DIAGNOSTICS};
use super::input::{MAX_TEXT, source};

/// What was read of one text, before its names mean anything.
struct Text {
    file: RequirementFile,
    diagnostics: Vec<Diagnostic>,
    source: Source,
    /// Whether it stands in the comments of the program.
    is_program: bool,
}

/// All that is asked, in the order in which it is answered.
pub struct Asked {
    texts: Vec<Text>,
    failed: bool,
}

/// What is asked of a system, and what is assumed of it.
#[derive(Default)]
pub struct Bound {
    pub requirements: Vec<(Requirement, Demand)>,
    pub assumptions: Vec<Assumption>,
    pub assertions: Vec<Assertion>,
    pub fairness_texts: Vec<FairnessText>,
    pub fairness: Vec<FairnessAssumption>,
}

impl Asked {
    /// Reads the domains, requirements and requirement files of a command.
    pub fn read(arguments: &Check, console: &Console) -> Result<Self, Failure> {
        let mut asked = Self { texts: Vec::new(), failed: false };
        for (i, text) in arguments.domain.iter().enumerate() {
            let source = Source::new(format!("domain {}", i + 1), text.as_str());
            let (domains, diagnostics) = split(parse_domain(&source));
            asked.texts.push(Text {
                file: RequirementFile { domains, ..Default::default() },
                diagnostics,
                source,
                is_program: false,
            });
        }
        for (i, text) in arguments.fairness.iter().enumerate() {
            let source = Source::new(format!("fairness {}", i + 1), text.as_str());
            let (fairness, diagnostics) = split(parse_fairness(&source));
            asked.texts.push(Text {
                file: RequirementFile { fairness, ..Default::default() },
                diagnostics,
                source,
                is_program: false,
            });
        }
        for (i, text) in arguments.requirement.iter().enumerate() {
            let name = format!("r{}", i + 1);
            let source = Source::new(format!("formula {name}"), text.as_str());
            let (requirements, diagnostics) = split(parse_requirement(&name, &source));
            asked.texts.push(Text {
                file: RequirementFile { requirements, ..Default::default() },
                diagnostics,
                source,
                is_program: false,
            });
        }
        for file in &arguments.require {
            match source(file, MAX_TEXT, console) {
                Ok(source) => asked.read_text(source),
                Err(Failure::Reported) => asked.failed = true,
                Err(failure) => return Err(failure),
            }
        }
        Ok(asked)
    }

    /// Reads what stands in the comments of a program.
    pub fn read_comments(&mut self, program: &Source) {
        if let Some(text) = syntax::requirements_in_comments(program.text()) {
            let (file, diagnostics) = parse_requirements(&Source::new(program.name().to_owned(), text));
            // Everything stands where it stands in the program.
            let source = Source::new(program.name().to_owned(), program.text());
            self.texts.push(Text { file, diagnostics, source, is_program: true });
        }
    }

    fn read_text(&mut self, source: Source) {
        let (file, diagnostics) = parse_requirements(&source);
        self.texts.push(Text { file, diagnostics, source, is_program: false });
    }

    /// The plants that files name, as paths from where the program runs.
    pub fn plants(&self) -> Vec<PathBuf> {
        let of_text = |text: &Text| {
            let folder = Path::new(text.source.name()).parent().unwrap_or(Path::new("")).to_owned();
            text.file.plants.iter().map(move |plant| folder.join(&plant.path)).collect::<Vec<_>>()
        };
        self.texts.iter().flat_map(of_text).collect()
    }

    /// The time from one scan to the next that files give. A second one is reported with the requirements.
    pub fn scan_time(&mut self) -> Option<u64> {
        let mut first: Option<u64> = None;
        for text in &mut self.texts {
            let Some((time, span)) = text.file.scan_time else { continue };
            if first.is_some_and(|first| first != time) {
                let message = "another scan time was given already";
                text.diagnostics.push(Diagnostic::new(Code::RequirementSyntax, span, message).help("give one"));
            }
            first.get_or_insert(time);
        }
        first
    }

    /// The domains of a program's free inputs. What is wrong with them is reported with the requirements.
    pub fn domains(&mut self, program: &FlatProgram, plant: &Plant) -> Domains {
        let mut domains = Domains::new();
        for text in &mut self.texts {
            let bound = text.file.domains.iter().map(|domain| bind_domain(domain, program, plant, &mut domains));
            text.diagnostics.extend(bound.filter_map(Result::err));
        }
        domains
    }

    /// Everything else, bound.
    pub fn bind(self, system: &System, view: View, console: &Console) -> Result<Bound, Failure> {
        let mut failed = self.failed;
        let mut bound = Bound::default();
        for Text { file, mut diagnostics, source, is_program } in self.texts {
            for assumption in &file.assumptions {
                match bind_assumption(assumption, system, view) {
                    Ok(assumption) => bound.assumptions.push(assumption),
                    Err(errors) => diagnostics.extend(errors),
                }
            }
            for assertion in &file.assertions {
                let elsewhere = || {
                    let message = "an assertion stands in the program, before an instruction";
                    let help =
                        "write it there as `(*@ assert …; *)`; here, a requirement is `requirement name: AG (…);`";
                    Err(vec![Diagnostic::new(Code::AssertionUnfit, assertion.span, message).help(help)])
                };
                let assertion =
                    if is_program { bind_assertion(assertion, source.text(), system, view) } else { elsewhere() };
                match assertion {
                    Ok(assertion) => bound.assertions.push(assertion),
                    Err(errors) => diagnostics.extend(errors),
                }
            }
            for fairness in file.fairness {
                match bind_fairness(&fairness, system, view) {
                    Ok(assumption) => bound.fairness.push(assumption),
                    Err(errors) => diagnostics.extend(errors),
                }
                bound.fairness_texts.push(fairness);
            }
            let others = bound.requirements.len();
            for requirement in file.requirements {
                let known = &bound.requirements[..others];
                if known.iter().any(|(other, _)| other.name.eq_ignore_ascii_case(&requirement.name)) {
                    let message = format!("a requirement named `{}` was given already", requirement.name);
                    let help = "give each a name of its own; the formulas of `-r` are named r1, r2, …";
                    diagnostics.push(Diagnostic::new(Code::RequirementNameTwice, requirement.span, message).help(help));
                }
                if diagnostics.len() >= MAX_DIAGNOSTICS {
                    break;
                }
                match bind_requirement(&requirement, system, view) {
                    Ok(demand) => {
                        diagnostics.extend(requirement.doubt(view));
                        bound.requirements.push((told(requirement, &demand, system), demand));
                    }
                    Err(errors) => diagnostics.extend(errors),
                }
            }
            diagnostics.sort_by_key(Diagnostic::span);
            console.diagnostics(&diagnostics, &source);
            failed |= any_error(&diagnostics);
        }
        if failed { Err(Failure::Reported) } else { Ok(bound) }
    }
}

/// A formula of a pattern that is longer says less than the pattern.
const LONG: usize = 160;

/// The requirement with the formula that its pattern stands for.
fn told(requirement: Requirement, demand: &Demand, system: &System) -> Requirement {
    let formula = demand.text(system).filter(|_| requirement.words.is_some());
    match formula.filter(|text| text.len() <= LONG) {
        Some(text) => Requirement { text, ..requirement },
        None => requirement,
    }
}

/// What was read, or what is wrong, as a list of at most one.
fn split<T>(read: Result<T, Diagnostic>) -> (Vec<T>, Vec<Diagnostic>) {
    match read {
        Ok(read) => (vec![read], vec![]),
        Err(error) => (vec![], vec![error]),
    }
}
