//! Findings in words.

use super::super::formula::SignalId;
use super::super::specification::Specification;
use super::finding::{Doubt, Example, Finding};
use petril_base::diagnostic::{Code, Diagnostic};

/// Upper bound on names listed; the others are counted.
const NAMED: usize = 12;

impl Finding {
    /// The finding as a warning, for the file of its place.
    #[must_use]
    pub fn diagnostic(&self, specification: &Specification) -> Diagnostic {
        let told = Told { finding: self, specification };
        let mut diagnostic = Diagnostic::new(self.doubt.code(), self.place.span, told.message());
        let others = self.restrictions.iter().map(|at| &specification.restrictions[*at]);
        for restriction in
            others.filter(|other| other.place.file == self.place.file && other.place != self.place).take(5)
        {
            diagnostic = diagnostic.also(restriction.place.span, restriction.text.as_str());
        }
        if let Some(example) = &self.example {
            diagnostic = diagnostic.help(told.example(example));
        }
        diagnostic.help(told.help())
    }
}

impl Doubt {
    /// Diagnostic code.
    #[must_use]
    pub fn code(self) -> Code {
        match self {
            Self::InputNotUsed => Code::SifInputNotUsed,
            Self::InputWithoutEffect => Code::SifInputWithoutEffect,
            Self::InputListed => Code::SifInputListed,
            Self::InputNotListed => Code::SifInputNotListed,
            Self::Constant => Code::SifConstant,
            Self::Contradiction => Code::SifContradiction,
            Self::Implied => Code::SifImplied,
            Self::Apart => Code::SifApart,
            Self::CauseRemoved => Code::SifCauseRemoved,
            Self::NeverDecides => Code::SifNeverDecides,
            Self::Same => Code::SifSame,
            Self::ResetNever => Code::SifResetNever,
            Self::NotDecided => Code::SifNotDecided,
        }
    }
}

struct Told<'f> {
    finding: &'f Finding,
    specification: &'f Specification,
}

impl Told<'_> {
    fn signal(&self, position: usize) -> &str {
        self.finding.signals.get(position).map_or("", |id| self.specification.name(*id))
    }

    fn function(&self) -> &str {
        self.finding.function.map_or("", |at| self.specification.functions[at].name.as_str())
    }

    fn formula(&self) -> String {
        self.finding.formula.as_ref().map(|formula| self.specification.text(formula)).unwrap_or_default()
    }

    /// Names of the restrictions, without the first `without` ones.
    fn restrictions(&self, without: usize) -> Vec<String> {
        let names = self.finding.restrictions.iter().skip(without).map(|at| &self.specification.restrictions[*at].name);
        names.map(|name| format!("`{name}`")).collect()
    }

    /// ` under R1 and R2`, or empty.
    fn under(&self) -> String {
        match self.restrictions(0).as_slice() {
            [] => String::new(),
            [only] => format!(" under the restriction {only}"),
            names => format!(" under the restrictions {}", listed(names)),
        }
    }

    fn message(&self) -> String {
        let (first, second, function) = (self.signal(0), self.signal(1), self.function());
        match self.finding.doubt {
            Doubt::InputNotUsed => format!("no equation uses the input `{first}`"),
            Doubt::InputWithoutEffect => {
                format!("the input `{first}` makes no difference to any output{}", self.under())
            }
            Doubt::InputListed => format!("function `{function}` lists `{first}` and does not use it"),
            Doubt::InputNotListed => {
                let names: Vec<String> =
                    self.finding.signals.iter().map(|id| format!("`{}`", self.specification.name(*id))).collect();
                format!(
                    "function `{function}` uses {} and does not list {}",
                    listed(&names),
                    if names.len() == 1 { "it" } else { "them" }
                )
            }
            Doubt::Constant => {
                format!("`{first}` is always {}{}", if self.finding.value { "TRUE" } else { "FALSE" }, self.under())
            }
            Doubt::Contradiction => {
                let what = match self.restrictions(0).as_slice() {
                    [only] => format!("the restriction {only} can never be kept"),
                    names => format!("the restrictions {} contradict each other", listed(names)),
                };
                if function.is_empty() { what } else { format!("{what}: `{function}` has no test") }
            }
            Doubt::Implied => {
                let name = self.restrictions(0).into_iter().next().unwrap_or_default();
                match self.restrictions(1).as_slice() {
                    [] => format!("the restriction {name} excludes nothing"),
                    [only] => format!("the restriction {name} excludes nothing that {only} does not"),
                    names => format!("the restriction {name} excludes nothing that {} together do not", listed(names)),
                }
            }
            Doubt::Apart => {
                let name = self.restrictions(0).into_iter().next().unwrap_or_default();
                let whom =
                    if function.is_empty() { "any function".to_owned() } else { format!("the function `{function}`") };
                format!("the restriction {name} has nothing to do with {whom}")
            }
            Doubt::CauseRemoved => {
                let cause = self.formula();
                format!("no test is left in which `{cause}` makes `{first}` TRUE{}", self.under())
            }
            Doubt::NeverDecides => {
                let nth = self.finding.nth.map(|nth| format!("{} ", ordinal(nth))).unwrap_or_default();
                format!("the {nth}`{}` of `{first}` never decides{}", self.formula(), self.under())
            }
            Doubt::Same => {
                let how = if self.finding.value { "the same" } else { "opposites" };
                format!("`{first}` and `{second}` are always {how}{}", self.under())
            }
            Doubt::ResetNever => format!("`{first}` is never reset{}", self.under()),
            Doubt::NotDecided => {
                let question = self.finding.question.as_deref().unwrap_or_default();
                format!("it is not decided whether {question}")
            }
        }
    }

    /// Sentence about an example.
    fn example(&self, example: &Example) -> String {
        let valuation = valuation(self.specification, &example.values);
        if self.finding.doubt == Doubt::Contradiction {
            let last = self.restrictions(0).pop().unwrap_or_default();
            return format!("without {last} there would be {valuation}");
        }
        if !example.is_excluded {
            return format!("so it is, for example, with {valuation}");
        }
        let names = self.restrictions(usize::from(self.finding.doubt == Doubt::Implied));
        let verb = if names.len() == 1 { "excludes" } else { "exclude" };
        format!("{} {verb}, for example, {valuation}", listed(&names))
    }

    fn help(&self) -> &'static str {
        match self.finding.doubt {
            Doubt::InputNotUsed => "use it, or remove its declaration",
            Doubt::InputWithoutEffect => "look whether an equation misses a part, or leave the input out",
            Doubt::InputListed => "use it in the section `formal`, or leave it out of the section `interface`",
            Doubt::InputNotListed => "list it in the section `interface`: `input NAME \"what it is\";`",
            Doubt::Constant => {
                "look whether the equation or a restriction says what is meant: there is nothing to test"
            }
            Doubt::Contradiction => {
                "look whether each says what is meant, `never` or `always`: no test keeps all of them"
            }
            Doubt::Implied => "leave it out, or look whether it says what is meant",
            Doubt::Apart => "look whether it names the inputs that it should, or leave it out",
            Doubt::CauseRemoved => {
                "if it cannot happen, the equation could do without it; else the restriction says too much"
            }
            Doubt::NeverDecides => "without it the output would be the same; look whether a restriction says too much",
            Doubt::Same => "if this is not meant, look whether one has the equation of the other",
            Doubt::ResetNever => "look whether what resets and what sets are as they are meant",
            Doubt::NotDecided => "the search was stopped; equations of fewer parts are decided sooner",
        }
    }
}

/// Valuation in words: signals that are TRUE, and those that are FALSE, listed if they are few.
fn valuation(specification: &Specification, values: &[(SignalId, bool)]) -> String {
    let of = |value: bool| -> Vec<String> {
        let signals = values.iter().filter(|(_, has)| *has == value);
        signals.map(|(id, _)| format!("`{}`", specification.name(*id))).collect()
    };
    let few = |names: &[String], value: &str| match names.len() {
        0 => None,
        count if count > NAMED => Some(format!("{} and {} others {value}", names[..NAMED].join(", "), count - NAMED)),
        _ => Some(format!("{} {value}", listed(names))),
    };
    let parts: Vec<String> = [few(&of(true), "TRUE"), few(&of(false), "FALSE")].into_iter().flatten().collect();
    if parts.is_empty() { "any valuation".to_owned() } else { parts.join(", ") }
}

/// `a`, `a and b`, `a, b and c`
fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

fn ordinal(number: usize) -> String {
    let ending = match (number % 100, number % 10) {
        (11..=13, _) => "th",
        (_, 1) => "st",
        (_, 2) => "nd",
        (_, 3) => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}
