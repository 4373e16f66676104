//! Proofs against programs are what every run shows, and what `petril check` says of the same in other words.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{HashSet, VecDeque};

use petril::explore::Budget;
use petril::flat::{FlatProgram, Tolerated};
use petril::interpret::Machine;
use petril::logic::{View, bind_assumption, bind_requirement, parse_requirements};
use petril::semantics::{Role, VarId};
use petril::sif::proof::{Failure, Options, Outcome, Subject, prove};
use petril::sif::{Kind, Specification, requirements};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::{self, Verdict, check};
use proptest::prelude::*;
use support::agreement::programs;
use support::random_program;

const INPUTS: [&str; 3] = ["i0", "i1", "i2"];

/// A formula as it is specified, and the IL that makes it the current result.
#[derive(Clone, Debug)]
enum Tree {
    Input(usize, bool),
    Join(&'static str, Box<Tree>, Box<Tree>),
}

impl Tree {
    fn text(&self) -> String {
        match self {
            Self::Input(input, negated) => format!("{}{}", if *negated { "!" } else { "" }, INPUTS[*input]),
            Self::Join(operator, a, b) => format!("({} {operator} {})", a.text(), b.text()),
        }
    }

    fn code(&self) -> String {
        match self {
            Self::Input(input, negated) => format!("LD{} {}\n", if *negated { "N" } else { "" }, INPUTS[*input]),
            Self::Join("->", a, b) => format!("{}NOT\nOR(\n{})\n", a.code(), b.code()),
            Self::Join("<->", a, b) => format!("{}XORN(\n{})\n", a.code(), b.code()),
            Self::Join(operator, a, b) => format!("{}{}(\n{})\n", a.code(), operator.to_uppercase(), b.code()),
        }
    }
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = (0..3_usize, any::<bool>()).prop_map(|(input, negated)| Tree::Input(input, negated));
    leaf.prop_recursive(3, 8, 2, |inner| {
        let operator = proptest::sample::select(vec!["and", "or", "xor", "->", "<->"]);
        (operator, inner.clone(), inner).prop_map(|(operator, a, b)| Tree::Join(operator, Box::new(a), Box::new(b)))
    })
}

/// A function with one output, restrictions of the whole system and of the function, and perhaps a latch.
fn specification(formula: &str, latched: Option<&Tree>, system: Option<&Tree>, own: Option<&Tree>) -> Specification {
    let latched = latched.map_or(String::new(), |reset| format!(" latched until {}", reset.text()));
    let restriction = |name: &str, tree: Option<&Tree>| {
        tree.map_or(String::new(), |tree| format!("restriction {name}: always {};", tree.text()))
    };
    let text = format!(
        "{}\nfunction F {{ interface {{ input i0; input i1; input i2; output q0{latched}; }} formal {{ q0 = {formula}; {} }} }}",
        restriction("R", system),
        restriction("S", own)
    );
    let (specification, diagnostics) = Specification::read(&[Source::new("random.sif", text.as_str())]);
    specification.unwrap_or_else(|| panic!("{text}\n{diagnostics:#?}"))
}

/// What every run shows, by trying all.
#[derive(Debug, Default)]
struct All {
    /// Scans of a shortest run after which the output is wrong.
    wrong: Option<usize>,
    /// Scans of a shortest run that keeps the restrictions of the system and never ends.
    endless: Option<usize>,
    /// Whether some scan keeps all restrictions and ends.
    ends: bool,
}

fn all_runs(specification: &Specification, program: &FlatProgram) -> All {
    let mut all = All::default();
    // Runs that keep all restrictions, and those that keep the system's, are different ones.
    for every in [true, false] {
        let inputs: Vec<VarId> = INPUTS.iter().map(|name| program.find(name).unwrap()).collect();
        let output = program.find("q0").unwrap();
        let names: Vec<usize> =
            INPUTS.iter().map(|name| specification.signals.iter().position(|own| own.name == *name).unwrap()).collect();
        let (formula, latched) = specification
            .signals
            .iter()
            .find_map(|signal| match &signal.kind {
                Kind::Defined { formula, latched, .. } => Some((formula, latched)),
                Kind::Input { .. } => None,
            })
            .unwrap();
        let start: Vec<u64> = program.variables.iter().map(|variable| variable.initial).collect();
        let mut queue = VecDeque::from([(start.clone(), false, 0)]);
        let mut known = HashSet::from([(start, false)]);
        while let Some((memory, latch, depth)) = queue.pop_front() {
            for bits in 0..8_u64 {
                let is = |signal: petril::sif::SignalId| {
                    let input = names.iter().position(|&name| name == signal.0);
                    input.is_some_and(|input| bits >> input & 1 == 1)
                };
                let mut restrictions = specification.restrictions.iter().filter(|own| every || own.name == "R");
                if !restrictions.all(|restriction| restriction.allowed.holds(is)) {
                    continue;
                }
                let wanted = formula.holds(is) || latch && latched.as_ref().is_some_and(|reset| !reset.holds(is));
                let mut machine = Machine::new(program);
                machine.restore(&memory);
                inputs.iter().enumerate().for_each(|(input, &id)| machine.set(id, bits >> input & 1));
                if machine.scan().is_err() {
                    if !every {
                        all.endless.get_or_insert(depth + 1);
                    }
                    continue;
                }
                if every {
                    all.ends = true;
                    if (machine.value(output) == 1) != wanted {
                        all.wrong.get_or_insert(depth + 1);
                    }
                }
                let memory: Vec<u64> = (0..program.variables.len())
                    .map(|id| if program.variables[id].role == Role::Buffer { 0 } else { machine.value(VarId(id)) })
                    .collect();
                let latch = latched.is_some() && wanted;
                if known.insert((memory.clone(), latch)) {
                    queue.push_back((memory, latch, depth + 1));
                }
            }
        }
    }
    all
}

/// The verdict of `petril check` on the specification as requirements.
fn checked(specification: &Specification, program: &FlatProgram) -> Verdict {
    let text = requirements(specification);
    let system = System::new(program.clone(), Plant::default());
    let (file, errors) = parse_requirements(&Source::new("requirements", text.as_str()));
    assert!(errors.is_empty(), "{text}\n{errors:#?}");
    let bound = |requirement| bind_requirement(requirement, &system, View::Scan).unwrap();
    let asked: Vec<_> = file.requirements.iter().map(|own| (own.clone(), bound(own))).collect();
    let assumptions = file.assumptions.iter().map(|own| bind_assumption(own, &system, View::Scan).unwrap()).collect();
    let options = verdict::Options { assumptions, budget: Budget::default(), ..verdict::Options::default() };
    check(&system, &asked, &options, &mut |_| None).answers[0].outcome.verdict()
}

fn agree(specification: &Specification, program: &FlatProgram, tries: u64) -> Result<Verdict, TestCaseError> {
    let subject = Subject::new(specification, program, Tolerated::default(), &[]).unwrap();
    let proof = prove(&subject, &Options { scans: 70, tries, ..Options::default() });
    let all = all_runs(specification, program);
    let outcome = &proof.answers[0].outcome;
    match outcome {
        Outcome::Proved { .. } => prop_assert!(all.wrong.is_none() && all.ends, "{:?} {:?}", all, proof),
        Outcome::Refuted(scans) => {
            prop_assert_eq!(all.wrong, Some(scans.len()), "{:?}", proof);
            prop_assert!(scans.iter().all(|scan| scan.broken.is_empty()));
        }
        // 70 scans are more than states of six bits.
        Outcome::Unknown(why) => {
            let is_vacuous = all.wrong.is_none() && !all.ends;
            prop_assert!(is_vacuous || tries == 0 && why.contains("goes back"), "{:?} {}", all, why);
        }
    }
    let endless: Vec<_> = proof.failures.iter().map(|(failure, scans)| (*failure, scans.len())).collect();
    if tries > 0 {
        prop_assert_eq!(endless, all.endless.map(|scans| (Failure::Endless, scans)).into_iter().collect::<Vec<_>>());
    }
    Ok(outcome.verdict())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(300)))]

    /// Programs that have little to do with what is specified; two restrictions and a latch.
    #[test]
    fn on_random_programs(
        text in random_program::text(8),
        formula in tree(),
        latched in proptest::option::of(tree()),
        restrictions in (proptest::option::of(tree()), proptest::option::of(tree())),
        tries in proptest::sample::select(vec![0, 1 << 16]),
    ) {
        let specification =
            specification(&formula.text(), latched.as_ref(), restrictions.0.as_ref(), restrictions.1.as_ref());
        agree(&specification, &support::program(&text), tries)?;
    }

    /// Programs that compute what is specified behind whatever else they do, or nearly.
    #[test]
    fn on_programs_that_may_be_right(
        text in random_program::text(5),
        (formula, other) in (tree(), tree()),
        (is_right, is_latched, sets_first) in (prop::bool::weighted(0.7), any::<bool>(), any::<bool>()),
        (reset, restriction) in (tree(), proptest::option::of(tree())),
        tries in proptest::sample::select(vec![0, 1 << 16]),
    ) {
        let computed = if is_right { &formula } else { &other };
        let (trigger, resets) = (computed.code(), reset.code());
        let own = match (is_latched, sets_first) {
            (false, _) => format!("{trigger}ST q0\n"),
            (true, true) => format!("{resets}R q0\n{trigger}S q0\n"),
            (true, false) => format!("LD q0\nANDN(\n{resets})\nOR(\n{trigger})\nST q0\n"),
        };
        // What was random says something else to another output, and comes to the end.
        let text = text.replace("q0", "q1").replace(", q1 : BOOL", ", q0 : BOOL");
        let text = text.replacen("VAR_OUTPUT q1", "VAR_OUTPUT q0 : BOOL; END_VAR\nVAR_OUTPUT q1", 1);
        let text = remove_second_declaration(&text).replace("RETC", "NOT\nST q1\nLD i0\nST q1 (*").replace("(*N", "(*");
        let text = text.replace("(*\n", "\n");
        let text = text.replace("END_PROGRAM", &format!("{own}END_PROGRAM"));
        let program = support::program(&text);
        let latched = is_latched.then_some(&reset);
        let specification = specification(&formula.text(), latched, restriction.as_ref(), None);
        let found = agree(&specification, &program, tries)?;
        // Of a latch, `petril check` asks nothing at power-on.
        if latched.is_none() && found != Verdict::Unknown {
            // After scans that never end, it says nothing of the others.
            let checked = checked(&specification, &program);
            let endless = all_runs(&specification, &program).endless.is_some();
            prop_assert!(found == checked || endless && checked == Verdict::Unknown, "{:?} {:?}", found, checked);
        }
    }
}

/// One declaration of `q1` is enough.
fn remove_second_declaration(text: &str) -> String {
    let mut seen = false;
    let keep = |line: &&str| {
        let is_declaration = line.starts_with("VAR_OUTPUT q1");
        let again = is_declaration && seen;
        seen |= is_declaration;
        !again
    };
    text.lines().filter(keep).map(|line| format!("{line}\n")).collect()
}

/// Two functions, of which the second may name the output of the first; each may have a latch and a restriction of its own.
#[derive(Clone, Debug)]
struct Pair {
    formulas: [Tree; 2],
    uses: Option<&'static str>,
    resets: [Option<Tree>; 2],
    restrictions: [Option<Tree>; 2],
    /// What the program does instead, if it is wrong.
    wrong: [Option<Tree>; 2],
}

fn pair() -> impl Strategy<Value = Pair> {
    let optional =
        |chance: f64| (proptest::option::weighted(chance, tree()), proptest::option::weighted(chance, tree()));
    let uses = proptest::option::of(proptest::sample::select(vec!["and", "or", "xor"]));
    ((tree(), tree()), uses, optional(0.5), optional(0.4), optional(0.2)).prop_map(
        |(f, uses, resets, restrictions, wrong)| {
            let [formulas, resets, restrictions, wrong] =
                [(Some(f.0), Some(f.1)), resets, restrictions, wrong].map(|(a, b)| [a, b]);
            Pair { formulas: formulas.map(Option::unwrap), uses, resets, restrictions, wrong }
        },
    )
}

impl Pair {
    fn specification(&self) -> Specification {
        let function = |at: usize| {
            let latched = self.resets[at].as_ref().map_or(String::new(), |r| format!(" latched until {}", r.text()));
            let restriction = self.restrictions[at].as_ref();
            let restriction = restriction.map_or(String::new(), |r| format!("restriction S{at}: always {};", r.text()));
            let used = if at == 1 { self.uses } else { None };
            let used = used.map_or(String::new(), |operator| format!(" {operator} q0"));
            format!(
                "function F{at} {{ interface {{ input i0; input i1; input i2; output q{at}{latched}; }} \
                 formal {{ q{at} = {}{used}; {restriction} }} }}\n",
                self.formulas[at].text()
            )
        };
        let text = function(0) + &function(1);
        let (specification, diagnostics) = Specification::read(&[Source::new("pair.sif", text.as_str())]);
        specification.unwrap_or_else(|| panic!("{text}\n{diagnostics:#?}"))
    }

    fn program(&self) -> FlatProgram {
        let mut body = String::new();
        for at in 0..2 {
            body += &self.wrong[at].as_ref().unwrap_or(&self.formulas[at]).code();
            if let (1, Some(operator)) = (at, self.uses) {
                body += &format!("{} q0\n", operator.to_uppercase());
            }
            // The latch is a variable of its own, copied to the output.
            match &self.resets[at] {
                None => body += &format!("ST q{at}\n"),
                Some(reset) => body += &format!("ST m\n{}R k{at}\nLD m\nS k{at}\nLD k{at}\nST q{at}\n", reset.code()),
            }
        }
        support::program(&format!(
            "PROGRAM p VAR_INPUT i0, i1, i2 : BOOL; END_VAR VAR_OUTPUT q0, q1 : BOOL; END_VAR \
             VAR m, k0, k1 : BOOL; END_VAR\n{body}END_PROGRAM"
        ))
    }

    /// Scans of a shortest run that keeps the restriction of a function and after which its output is wrong; whether there is a run at all.
    fn shortest(&self, program: &FlatProgram, of: usize) -> (Option<usize>, bool) {
        let ids = INPUTS.map(|name| program.find(name).unwrap());
        let outputs = ["q0", "q1"].map(|name| program.find(name).unwrap());
        let start: Vec<u64> = program.variables.iter().map(|variable| variable.initial).collect();
        let mut queue = VecDeque::from([(start.clone(), [false; 2], 1)]);
        let mut known = HashSet::from([(start, [false; 2])]);
        let mut is_possible = false;
        while let Some((memory, latches, depth)) = queue.pop_front() {
            for bits in 0..8_u64 {
                let value = |tree: &Tree| tree.value(bits);
                if self.restrictions[of].as_ref().is_some_and(|restriction| !value(restriction)) {
                    continue;
                }
                is_possible = true;
                let mut now = [false; 2];
                for at in 0..2 {
                    let formula = value(&self.formulas[at]);
                    let formula = match (at, self.uses) {
                        (1, Some("and")) => formula && now[0],
                        (1, Some("or")) => formula || now[0],
                        (1, Some(_)) => formula != now[0],
                        _ => formula,
                    };
                    now[at] = formula || latches[at] && self.resets[at].as_ref().is_some_and(|reset| !value(reset));
                }
                let mut machine = Machine::new(program);
                machine.restore(&memory);
                ids.iter().enumerate().for_each(|(input, &id)| machine.set(id, bits >> input & 1));
                machine.scan().unwrap();
                if (machine.value(outputs[of]) == 1) != now[of] {
                    return (Some(depth), true);
                }
                let memory: Vec<u64> = (0..program.variables.len()).map(VarId).map(|id| machine.value(id)).collect();
                if known.insert((memory.clone(), now)) {
                    queue.push_back((memory, now, depth + 1));
                }
            }
        }
        (None, is_possible)
    }
}

impl Tree {
    fn value(&self, bits: u64) -> bool {
        match self {
            Self::Input(input, negated) => (bits >> input & 1 == 1) != *negated,
            Self::Join(operator, a, b) => {
                let (a, b) = (a.value(bits), b.value(bits));
                match *operator {
                    "and" => a && b,
                    "or" => a || b,
                    "xor" => a != b,
                    "->" => !a || b,
                    _ => a == b,
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(500)))]

    /// What is proved of one output is used for the other only where it holds. Nothing is tried by the interpreter.
    #[test]
    fn on_two_functions(pair in pair()) {
        let (specification, program) = (pair.specification(), pair.program());
        let subject = Subject::new(&specification, &program, Tolerated::default(), &[]).unwrap();
        let proof = prove(&subject, &Options { scans: 130, tries: 0, ..Options::default() });
        for (of, answer) in proof.answers.iter().enumerate() {
            let (shortest, is_possible) = pair.shortest(&program, of);
            match &answer.outcome {
                Outcome::Proved { .. } => prop_assert!(shortest.is_none() && is_possible, "{of} {shortest:?}"),
                Outcome::Refuted(scans) => prop_assert_eq!(shortest, Some(scans.len()), "{}", of),
                Outcome::Unknown(why) => prop_assert!(!is_possible, "{of} {why}"),
            }
        }
    }
}
