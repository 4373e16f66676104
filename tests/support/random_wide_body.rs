//! Random instruction lists over what a scope names. Every statement begins with a value of its own.

use std::fmt::Write;

use petril::semantics::Kind;

use super::random_flat::Choices;
use super::random_wide_program::{BOOL, Entry, InOut, Of, Scope, Unit, literal};

/// The list of a unit, with labels for the jumps in it. A function gets a result.
pub fn body(choices: &mut Choices<'_>, scope: &mut Scope, statements: usize) -> String {
    let count = 1 + choices.pick(statements);
    let mut writer = Writer { choices, scope, out: String::new(), label: 0, count, forks: 0, lists: 0 };
    for number in 0..count {
        writer.label = number;
        let _ = writeln!(writer.out, "l{number}:");
        writer.statement();
    }
    let _ = writeln!(writer.out, "l{count}:");
    writer.out
}

pub struct Writer<'c, 'n> {
    pub choices: &'c mut Choices<'n>,
    pub scope: &'c mut Scope,
    out: String,
    /// The statement in the making, and how many there are.
    label: usize,
    count: usize,
    /// How many statements are one of two.
    forks: usize,
    /// How many lists are open.
    lists: usize,
}

impl Writer<'_, '_> {
    pub fn line(&mut self, line: &str) {
        self.out += line;
        self.out.push('\n');
    }

    fn statement(&mut self) {
        match self.choices.pick(15) {
            0 => {
                self.value(BOOL, 0);
                let element = match self.choices.pick(4) {
                    0 => self.some_place(BOOL, |entry| entry.written && !entry.ranges.is_empty()),
                    _ => None,
                };
                if let Some(place) = element.or_else(|| self.place(BOOL, true)) {
                    let operator = self.choices.of(&["S", "R"]);
                    self.line(&format!("{operator} {place}"));
                }
            }
            1 => {
                self.value(BOOL, 0);
                let target = self.label + 1 + self.choices.pick(self.count - self.label);
                let operator = self.choices.of(&["JMPC", "JMPCN"]);
                self.line(&format!("{operator} l{target}"));
            }
            2 => self.turns(),
            3 => {
                self.value(BOOL, 0);
                let operator = self.choices.of(&["RETC", "RETCN"]);
                self.line(operator);
            }
            4..7 if !self.scope.instances.is_empty() => self.instance(),
            7 => self.either(),
            8 | 9 if !self.scope.functions.is_empty() => self.called(),
            _ => self.assignment(),
        }
    }

    /// A value, stored once or twice.
    fn assignment(&mut self) {
        let written: Vec<Of> = self.scope.entries.iter().filter(|entry| entry.written).map(|entry| entry.of).collect();
        let of = if written.is_empty() { BOOL } else { self.choices.of(&written) };
        if self.scope.plain {
            self.load(of);
        } else {
            self.value(of, 0);
        }
        for _ in 0..1 + self.choices.pick(2) {
            if let Some(place) = self.place(of, true) {
                let operator = if is_bits(of) && self.choices.pick(4) == 0 { "STN" } else { "ST" };
                self.line(&format!("{operator} {place}"));
            }
        }
    }

    /// What a function returns, stored if a variable can take it.
    fn called(&mut self) {
        let position = self.choices.pick(self.scope.functions.len());
        let of = self.scope.functions[position].result.unwrap_or(BOOL);
        self.function(of, 0);
        if let Some(place) = self.place(of, true) {
            self.line(&format!("ST {place}"));
        }
    }

    /// One of two assignments; the unit may end with the first.
    fn either(&mut self) {
        let fork = self.forks;
        self.forks += 1;
        self.value(BOOL, 0);
        self.line(&format!("JMPCN other{fork}"));
        self.assignment();
        let end = if self.choices.pick(3) == 0 { "RET".to_owned() } else { format!("JMP behind{fork}") };
        self.line(&format!("{end}\nother{fork}:"));
        self.assignment();
        self.line(&format!("behind{fork}:"));
    }

    /// A statement that is executed one to three times.
    fn turns(&mut self) {
        let (number, times) = (self.scope.loops, 1 + self.choices.pick(3));
        self.scope.loops += 1;
        let label = format!("turn{number}_{}", self.label);
        self.line(&format!("LD USINT#0\nST turn{number}\n{label}:"));
        self.assignment();
        let count = format!("LD turn{number}\nADD 1\nST turn{number}");
        let end = match self.choices.pick(3) {
            0 => format!("{count}\nLT {times}\nJMPC {label}"),
            1 => format!("{count}\nGE {times}\nJMPCN {label}"),
            _ => format!("{count}\nGE {times}\nJMPC after_{label}\nJMP {label}\nafter_{label}:"),
        };
        self.line(&end);
    }

    /// A call of a function block, in one of the notations.
    fn instance(&mut self) {
        let position = self.choices.pick(self.scope.instances.len());
        let (name, unit) = self.scope.instances[position].clone();
        let operators = ["S1", "R1", "S", "R", "CLK", "CU", "CD", "PV", "IN", "PT"];
        let with_operator = |(input, _): &&(String, Of)| operators.contains(&input.as_str());
        let inputs: Vec<(String, Of)> = unit.inputs.iter().filter(with_operator).cloned().collect();
        if !inputs.is_empty() && unit.in_out.is_none() && self.choices.flag() {
            let (input, of) = &inputs[self.choices.pick(inputs.len())];
            self.value(*of, 0);
            return self.line(&format!("{input} {name}"));
        }
        for (input, of) in &unit.inputs {
            if self.choices.pick(4) == 0 {
                self.value(*of, 1);
                self.line(&format!("ST {name}.{input}"));
            }
        }
        let Some(arguments) = self.arguments(&unit, true) else { return };
        let operator = match self.choices.pick(3) {
            0 => "CAL",
            more => {
                self.value(BOOL, 1);
                if more == 1 { "CALC" } else { "CALCN" }
            }
        };
        let arguments = if arguments.is_empty() { arguments } else { format!("({arguments})") };
        self.line(&format!("{operator} {name}{arguments}"));
    }

    /// What is handed over to a function or function block; nothing if it cannot be called here.
    pub fn arguments(&mut self, unit: &Unit, may_leave_out: bool) -> Option<String> {
        let in_out = match &unit.in_out {
            None => None,
            Some((name, InOut::Row)) => Some((name, self.scope.rows.first()?.clone())),
            Some((name, InOut::Pair)) => Some((name, self.scope.pairs.first()?.clone())),
            Some((name, InOut::One(of))) => Some((name, self.bound(*of)?)),
            Some((name, InOut::Counter)) => {
                let counters = self.scope.instances.iter().filter(|(_, unit)| unit.name == "CTU");
                let counters: Vec<String> = counters.map(|(name, _)| name.clone()).collect();
                counters.first()?;
                Some((name, self.choices.of(&counters.iter().map(String::as_str).collect::<Vec<_>>()).to_owned()))
            }
        };
        let mut list = Vec::new();
        // By position, in-out variables come in the order of declaration: behind the inputs.
        let is_positional = self.choices.pick(4) == 0;
        for (name, of) in &unit.inputs {
            if is_positional {
                list.push(self.operand(*of, true));
            } else if !may_leave_out || self.choices.pick(4) > 0 {
                let value = if self.choices.pick(5) == 0 { self.list(*of) } else { self.operand(*of, true) };
                list.push(format!("{name} := {value}"));
            }
        }
        if let Some((name, place)) = in_out {
            list.push(if is_positional { place } else { format!("{name} := {place}") });
        }
        if is_positional {
            return Some(list.join(", "));
        }
        for (name, of) in &unit.outputs {
            if self.choices.flag()
                && let Some(place) = self.place(*of, true)
            {
                let not = if is_bits(*of) && self.choices.pick(3) == 0 { "NOT " } else { "" };
                list.push(format!("{not}{name} => {place}"));
            }
        }
        self.enable(&mut list);
        Some(list.join(", "))
    }

    pub fn enable(&mut self, list: &mut Vec<String>) {
        if self.choices.pick(6) == 0 {
            let value = if self.choices.pick(4) == 0 { self.list(BOOL) } else { self.operand(BOOL, true) };
            list.insert(self.choices.pick(list.len() + 1), format!("EN := {value}"));
        }
        if self.choices.pick(3) > 0 {
            return;
        }
        // Often a variable that the call reads or writes.
        let is_written = |place: &str| {
            let mut fits =
                self.scope.entries.iter().filter(|entry| entry.written && entry.of == BOOL && entry.ranges.is_empty());
            fits.any(|entry| format!("{}{}", entry.base, entry.member) == place)
        };
        let read = list
            .iter()
            .filter_map(|argument| Some(argument.split_once(" := ").or(argument.split_once(" => "))?.1.to_owned()));
        let read: Vec<String> = read.filter(|place| is_written(place)).collect();
        let place = match read.as_slice() {
            [_, ..] if self.choices.flag() => Some(read[self.choices.pick(read.len())].clone()),
            _ => self.place(BOOL, true),
        };
        if let Some(place) = place {
            let not = self.choices.of(&["", "NOT "]);
            list.insert(self.choices.pick(list.len() + 1), format!("{not}ENO => {place}"));
        }
    }

    /// `( LD x … )`, with parentheses and calls.
    pub fn list(&mut self, of: Of) -> String {
        let outer = std::mem::take(&mut self.out);
        self.lists += 1;
        if self.lists < 3 && self.choices.flag() {
            self.inner(of, 0);
        } else {
            self.load(of);
        }
        self.lists -= 1;
        let list = std::mem::replace(&mut self.out, outer);
        format!("(\n{list})")
    }

    /// A variable to bind to an in-out variable.
    pub fn bound(&mut self, of: Of) -> Option<String> {
        self.some_place(of, |entry| entry.written && entry.whole && !entry.base.contains(['.', '%']))
    }

    pub fn place(&mut self, of: Of, written: bool) -> Option<String> {
        self.some_place(of, |entry| entry.written || !written)
    }

    fn some_place(&mut self, of: Of, may: impl Fn(&Entry) -> bool) -> Option<String> {
        let fits: Vec<Entry> = self.scope.entries.iter().filter(|e| e.of == of && may(e)).cloned().collect();
        let entry = fits.get(self.choices.pick(fits.len().max(1)))?;
        let mut text = entry.base.clone();
        // Indices before and behind a member cannot both be variables, and `.m[0]` has its own.
        for ranges in &entry.ranges {
            let indices: Vec<String> = ranges.iter().map(|&range| self.index(range)).collect();
            text += &format!("[{}]", indices.join(", "));
        }
        Some(text + &entry.member)
    }

    fn index(&mut self, (lower, upper): (i64, i64)) -> String {
        let is_number = |of: Of| matches!(of, Of::Plain(ty) if matches!(ty.kind, Kind::Signed | Kind::Unsigned));
        let numbers: Vec<String> = (self.scope.entries.iter())
            .filter(|entry| entry.ranges.is_empty() && is_number(entry.of))
            .map(|entry| format!("{}{}", entry.base, entry.member))
            .collect();
        if numbers.is_empty() || self.choices.pick(3) == 0 {
            return (lower + self.choices.pick((upper - lower + 1) as usize) as i64).to_string();
        }
        numbers[self.choices.pick(numbers.len())].clone()
    }

    /// A variable or literal.
    pub fn operand(&mut self, of: Of, anchored: bool) -> String {
        match self.choices.pick(4) {
            0 => literal(self.choices, of, anchored),
            _ => self.place(of, false).unwrap_or_else(|| literal(self.choices, of, anchored)),
        }
    }

    pub fn load(&mut self, of: Of) {
        let operator = if is_bits(of) && self.choices.pick(4) == 0 { "LDN" } else { "LD" };
        let operand = self.operand(of, true);
        self.line(&format!("{operator} {operand}"));
    }
}

pub fn is_bits(of: Of) -> bool {
    matches!(of, Of::Plain(ty) if ty.kind == Kind::Bits)
}
