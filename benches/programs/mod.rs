//! Programs for measurements: generated, and the same on every machine.
#![allow(dead_code, reason = "each measurement uses a part")]
#![allow(clippy::panic, reason = "a generated program that cannot be read is an error of the generator")]

use petril::flat::{FlatProgram, flatten};
use petril::logic::{Bound, View, bind, parse_formula};
use petril::semantics;
use petril::source::Source;
use petril::syntax;
use petril::translate::{Plant, System};

/// A linear congruential generator with Knuth's constants for MMIX.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    fn choose<'a>(&mut self, words: &'a [String]) -> &'a str {
        &words[self.below(words.len())]
    }
}

/// The longest rung of [`mixed`].
const RUNG: usize = 10;

/// A program of this many instructions: loads, combinations, parentheses, writes, and jumps forward, over variables whose
/// number grows with the program. An opening parenthesis counts as an instruction, a closing one does not.
pub fn mixed(instructions: usize) -> String {
    let count = 2 + instructions / 20;
    let names = |letter: char, count: usize| (0..count).map(|i| format!("{letter}{i}")).collect::<Vec<String>>();
    let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<String>>();
    let (inputs, memory, outputs) = (names('i', count), names('m', 2 * count), names('q', count));
    let written = [memory.clone(), outputs.clone()].concat();
    let read = [inputs.clone(), written.clone()].concat();
    let (loads, combines, writes) = (words("LD LD LDN"), words("AND ANDN OR ORN XOR"), words("ST ST STN S R"));

    let mut numbers = Numbers(instructions as u64);
    let mut body: Vec<String> = Vec::with_capacity(instructions);
    while body.len() + RUNG <= instructions {
        let mut say = |numbers: &mut Numbers, operators: &[String], operands: &[String]| {
            body.push(format!("    {:<5} {}", numbers.choose(operators), numbers.choose(operands)));
        };
        say(&mut numbers, &loads, &read);
        for _ in 0..=numbers.below(2) {
            say(&mut numbers, &combines, &read);
        }
        if numbers.below(4) == 0 {
            say(&mut numbers, &words("AND( OR( ORN( XOR("), &read);
            say(&mut numbers, &combines, &read);
            body.push(format!("    OR    {}\n    )", numbers.choose(&read)));
        }
        if numbers.below(10) == 0 {
            let label = format!("over{}", body.len());
            body.push(format!("    JMPC  {label}"));
            body.push(format!("    S     {}", numbers.choose(&written)));
            body.push(format!("{label}:\n    LD    {}", numbers.choose(&read)));
        }
        body.push(format!("    {:<5} {}", numbers.choose(&writes), numbers.choose(&written)));
    }
    while body.len() < instructions {
        body.push(format!("    LD    {}", numbers.choose(&read)));
    }
    let block = |kind: &str, names: &[String]| format!("{kind}\n    {} : BOOL;\nEND_VAR\n", names.join(", "));
    let blocks = [block("VAR_INPUT", &inputs), block("VAR", &memory), block("VAR_OUTPUT", &outputs)].concat();
    format!("PROGRAM mixed\n{blocks}{}\nEND_PROGRAM\n", body.join("\n"))
}

/// A program of this many instructions on numbers of a type: sums and differences, compared with one another.
pub fn numbers(ty: &str, instructions: usize) -> String {
    let rungs = ["LD    a", "ADD   b", "ST    m", "SUB   c", "GT    a", "ST    q"];
    let body: Vec<String> = rungs.iter().cycle().take(instructions).map(|rung| format!("    {rung}")).collect();
    format!(
        "PROGRAM numbers\nVAR_INPUT a, b, c : {ty}; END_VAR\nVAR m : {ty}; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\n{}\nEND_PROGRAM\n",
        body.join("\n")
    )
}

/// A program that filters contacts that bounce: each input is shifted through a history of some scans; a filtered value is
/// set where the whole history is TRUE, and reset where it is FALSE. Inputs are independent, and any history can be, so
/// that it has (2 · (2^scans − 1))^inputs states at the end of a scan, and 2^inputs steps from each.
pub fn filters(inputs: usize, scans: usize) -> String {
    let (mut declared, mut body) = (Vec::new(), Vec::new());
    for i in 0..inputs {
        let history: Vec<String> = (0..scans).map(|age| format!("Was{i}_{age}")).collect();
        declared.push(history.join(", "));
        for age in (1..scans).rev() {
            body.push(format!("LD    {}\nST    {}", history[age - 1], history[age]));
        }
        body.push(format!("LD    In{i}\nST    {}", history[0]));
        for (load, combine, write) in [("LD ", "AND ", "S"), ("LDN", "ANDN", "R")] {
            body.push(format!("{load}   {}", history[0]));
            body.extend(history[1..].iter().map(|earlier| format!("{combine:<5} {earlier}")));
            body.push(format!("{write}     On{i}"));
        }
    }
    let names = |stem: &str| (0..inputs).map(|i| format!("{stem}{i}")).collect::<Vec<_>>().join(", ");
    format!(
        "PROGRAM filters\nVAR_INPUT {} : BOOL; END_VAR\nVAR_OUTPUT {} : BOOL; END_VAR\nVAR {} : BOOL; END_VAR\n{}\nEND_PROGRAM\n",
        names("In"),
        names("On"),
        declared.join(", "),
        body.join("\n")
    )
}

/// The flat code of a program.
pub fn flat(text: &str) -> FlatProgram {
    let (unit, errors) = syntax::parse(&Source::new("generated", text));
    let (program, more) = semantics::check(&unit, errors.is_empty());
    flatten(&program.unwrap_or_else(|| panic!("{text}\n{errors:#?}\n{more:#?}")))
}

/// A program without a plant: every input is free.
pub fn system(text: &str) -> System {
    System::new(flat(text), Plant::default())
}

/// A formula over the variables of a program, for the scan view.
pub fn formula(text: &str, system: &System) -> Bound {
    let formula = parse_formula(&Source::new("formula", text)).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    bind(&formula, system, View::Scan).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}
