//! Requirements and domains in, from files and from the command line.

use std::path::Path;

use petril::diagnostic::{Code, Diagnostic, any_error};
use petril::flat::FlatProgram;
use petril::logic::{
    Bound, Requirement, RequirementFile, View, bind, bind_domain, parse_domain, parse_formula, parse_requirements,
};
use petril::source::Source;
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
}

/// All that is asked, in the order in which it is answered.
pub struct Asked {
    texts: Vec<Text>,
    failed: bool,
}

impl Asked {
    /// Reads the domains, formulas and requirement files of a command.
    pub fn read(arguments: &Check, console: &Console) -> Result<Self, Failure> {
        let mut asked = Self { texts: Vec::new(), failed: false };
        for (i, text) in arguments.domain.iter().enumerate() {
            let source = Source::new(format!("domain {}", i + 1), text.as_str());
            let (domains, diagnostics) = split(parse_domain(&source));
            asked.texts.push(Text { file: RequirementFile { requirements: vec![], domains }, diagnostics, source });
        }
        for (i, formula) in arguments.requirement.iter().enumerate() {
            let name = format!("r{}", i + 1);
            let source = Source::new(format!("formula {name}"), formula.as_str());
            let (requirements, diagnostics) = split(parse_formula(&name, &source));
            asked.texts.push(Text { file: RequirementFile { requirements, domains: vec![] }, diagnostics, source });
        }
        for file in &arguments.require {
            asked.read_file(file, console)?;
        }
        Ok(asked)
    }

    fn read_file(&mut self, path: &Path, console: &Console) -> Result<(), Failure> {
        match source(path, MAX_TEXT, console) {
            Ok(source) => {
                let (file, diagnostics) = parse_requirements(&source);
                self.texts.push(Text { file, diagnostics, source });
            }
            Err(Failure::Reported) => self.failed = true,
            Err(failure) => return Err(failure),
        }
        Ok(())
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

    /// The requirements, bound.
    pub fn requirements(
        self,
        system: &System,
        view: View,
        console: &Console,
    ) -> Result<Vec<(Requirement, Bound)>, Failure> {
        let mut failed = self.failed;
        let mut bound: Vec<(Requirement, Bound)> = Vec::new();
        for Text { file, mut diagnostics, source } in self.texts {
            let others = bound.len();
            for requirement in file.requirements {
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
}

/// What was read, or what is wrong, as a list of at most one.
fn split<T>(read: Result<T, Diagnostic>) -> (Vec<T>, Vec<Diagnostic>) {
    match read {
        Ok(read) => (vec![read], vec![]),
        Err(error) => (vec![], vec![error]),
    }
}
