//! Requirements, assumptions, assertions and domains from files, the command line and program comments.

use std::path::{Path, PathBuf};

use petril::diagnostic::{Code, Diagnostic, any_error};
use petril::exchange::plcverif::{self, Property};
use petril::flat::FlatProgram;
use petril::logic::{
    Assertion, Assumption, Demand, FairnessAssumption, FairnessText, Requirement, RequirementFile, View,
    bind_assertion, bind_assumption, bind_domain, bind_fairness, bind_requirement, parse_domain, parse_fairness,
    parse_requirement, parse_requirements,
};
use petril::source::{Source, Span};
use petril::syntax;
use petril::translate::{Domains, Plant, System};

use super::Failure;
use super::args::Check;
use super::console::{Console, MAX_DIAGNOSTICS};
use super::input::{MAX_TEXT, source};

/// Parsed text before name resolution.
struct Text {
    file: RequirementFile,
    diagnostics: Vec<Diagnostic>,
    source: Source,
    /// Whether the text is in comments of the program.
    is_program: bool,
    /// Description of its only requirement, if it parses as a pattern sentence.
    described: Option<Requirement>,
}

impl Text {
    fn new(file: RequirementFile, diagnostics: Vec<Diagnostic>, source: Source) -> Self {
        Self { file, diagnostics, source, is_program: false, described: None }
    }
}

/// Parsed texts in the order of their answers.
pub struct Asked {
    texts: Vec<Text>,
    failed: bool,
}

/// Bound requirements and assumptions of a system.
#[derive(Default)]
pub struct Bound {
    pub requirements: Vec<(Requirement, Demand)>,
    pub assumptions: Vec<Assumption>,
    pub assertions: Vec<Assertion>,
    pub fairness_texts: Vec<FairnessText>,
    pub fairness: Vec<FairnessAssumption>,
}

impl Asked {
    /// Reads the domains, fairness assumptions, requirements and requirement files of a command.
    pub fn read(arguments: &Check, console: &Console) -> Result<Self, Failure> {
        let mut asked = Self { texts: Vec::new(), failed: false };
        for (i, text) in arguments.domain.iter().enumerate() {
            let source = Source::new(format!("domain {}", i + 1), text.as_str());
            let (domains, diagnostics) = split(parse_domain(&source));
            asked.texts.push(Text::new(RequirementFile { domains, ..Default::default() }, diagnostics, source));
        }
        for (i, text) in arguments.fairness.iter().enumerate() {
            let source = Source::new(format!("fairness {}", i + 1), text.as_str());
            let (fairness, diagnostics) = split(parse_fairness(&source));
            asked.texts.push(Text::new(RequirementFile { fairness, ..Default::default() }, diagnostics, source));
        }
        for (i, text) in arguments.requirement.iter().enumerate() {
            let name = format!("r{}", i + 1);
            let source = Source::new(format!("formula {name}"), text.as_str());
            let (requirements, diagnostics) = split(parse_requirement(&name, &source));
            asked.texts.push(Text::new(RequirementFile { requirements, ..Default::default() }, diagnostics, source));
        }
        for file in &arguments.require {
            match source(file, MAX_TEXT, console) {
                Ok(source) if file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) => {
                    asked.read_properties(source);
                }
                Ok(source) => asked.read_text(source),
                Err(Failure::Reported) => asked.failed = true,
                Err(failure) => return Err(failure),
            }
        }
        Ok(asked)
    }

    /// Reads the requirements in the comments of a program.
    pub fn read_comments(&mut self, program: &Source) {
        if let Some(text) = syntax::requirements_in_comments(program.text()) {
            let (file, diagnostics) = parse_requirements(&Source::new(program.name().to_owned(), text));
            // The positions are those of the whole program text.
            let source = Source::new(program.name().to_owned(), program.text());
            self.texts.push(Text { is_program: true, ..Text::new(file, diagnostics, source) });
        }
    }

    fn read_text(&mut self, source: Source) {
        let (file, diagnostics) = parse_requirements(&source);
        self.texts.push(Text::new(file, diagnostics, source));
    }

    /// Reads the properties of a PLCverif file, each as its own text.
    fn read_properties(&mut self, file: Source) {
        let properties = match plcverif::properties(file.text()) {
            Ok(properties) => properties,
            Err(error) => return self.texts.push(Text::new(RequirementFile::default(), vec![error], file)),
        };
        for (position, Property { name, sentence, asked }) in properties.into_iter().enumerate() {
            let place = format!("{}, property {}", file.name(), position + 1);
            match asked {
                plcverif::Asked::Pattern { short, described } => {
                    let source = Source::new(place, short);
                    let (mut requirements, diagnostics) = split(parse_requirement(&name, &source));
                    requirements.iter_mut().for_each(|requirement| requirement.sentence.clone_from(&sentence));
                    let described = described.map(|text| parse_requirement(&name, &Source::new("description", text)));
                    let described = described.and_then(Result::ok);
                    let read = RequirementFile { requirements, ..Default::default() };
                    self.texts.push(Text { described, ..Text::new(read, diagnostics, source) });
                }
                plcverif::Asked::Assertions => {
                    let message =
                        "this property asks for the assertions of the program, which are checked without asking";
                    let help = "they stand in its comments, like `(*@ assert a -> b; *)`; those of other languages are not read";
                    let source = Source::new(place, "assertion");
                    let told =
                        Diagnostic::new(Code::PropertyDoubtful, Span::new(0, source.text().len()), message).help(help);
                    self.texts.push(Text::new(RequirementFile::default(), vec![told], source));
                }
            }
        }
    }

    /// Plants named by the files, as paths relative to the working directory.
    pub fn plants(&self) -> Vec<PathBuf> {
        let of_text = |text: &Text| {
            let folder = Path::new(text.source.name()).parent().unwrap_or(Path::new("")).to_owned();
            text.file.plants.iter().map(move |plant| folder.join(&plant.path)).collect::<Vec<_>>()
        };
        self.texts.iter().flat_map(of_text).collect()
    }

    /// Scan time given by the files. Conflicting values are reported with the requirements.
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

    /// Domains of the free inputs. Errors are reported with the requirements.
    pub fn domains(&mut self, program: &FlatProgram, plant: &Plant) -> Domains {
        let mut domains = Domains::new();
        for text in &mut self.texts {
            let bound = text.file.domains.iter().map(|domain| bind_domain(domain, program, plant, &mut domains));
            text.diagnostics.extend(bound.filter_map(Result::err));
        }
        domains
    }

    /// Binds assumptions, assertions, fairness and requirements.
    pub fn bind(self, system: &System, view: View, console: &Console) -> Result<Bound, Failure> {
        let mut failed = self.failed;
        let mut bound = Bound::default();
        for Text { file, mut diagnostics, source, is_program, described } in self.texts {
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
                let described = described.as_ref().and_then(|described| bind_requirement(described, system, view).ok());
                match bind_requirement(&requirement, system, view) {
                    Ok(demand) => {
                        diagnostics.extend(requirement.doubt(view));
                        diagnostics
                            .extend(described.and_then(|other| contradiction(&requirement, [&demand, &other], system)));
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

/// Warning that the description of a property differs from its parameters, which are the ones checked.
fn contradiction(requirement: &Requirement, [asked, described]: [&Demand; 2], system: &System) -> Option<Diagnostic> {
    let said = described.formula().filter(|&said| asked.formula() != Some(said))?;
    let message = "the description of this property says something else than its parameters";
    let help = format!("the parameters are checked, and not `{}`", said.text(system));
    Some(Diagnostic::new(Code::PropertyDoubtful, requirement.span, message).help(help))
}

/// Maximum length of a formula shown instead of its pattern.
const LONG: usize = 160;

/// Requirement with the formula of its pattern, unless that is too long.
fn told(requirement: Requirement, demand: &Demand, system: &System) -> Requirement {
    let formula = demand.text(system).filter(|_| requirement.words.is_some());
    match formula.filter(|text| text.len() <= LONG) {
        Some(text) => Requirement { text, ..requirement },
        None => requirement,
    }
}

/// Parse result as a list of at most one item and one of at most one error.
fn split<T>(read: Result<T, Diagnostic>) -> (Vec<T>, Vec<Diagnostic>) {
    match read {
        Ok(read) => (vec![read], vec![]),
        Err(error) => (vec![], vec![error]),
    }
}
