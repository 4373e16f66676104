//! Random instructions that leave a value of a type.

use petril::semantics::{Kind, Type};

use super::random_wide_body::{Writer, is_bits};
use super::random_wide_program::{BOOL, InOut, Of, Unit};

impl Writer<'_, '_> {
    /// Some type that variables have.
    fn some(&mut self) -> Of {
        let types: Vec<Of> = self.scope.entries.iter().map(|entry| entry.of).collect();
        self.choices.of(&types)
    }

    /// Instructions that leave a value of a type, whatever the current result was.
    pub fn value(&mut self, of: Of, depth: usize) {
        let choice = if depth >= 3 { 0 } else { self.choices.pick(9) };
        match choice {
            5 | 6 if of == BOOL => self.comparison(depth),
            5 => match (of, self.some()) {
                (Of::Plain(to), Of::Plain(from)) if self.choices.pick(4) == 0 => {
                    let mut list = vec![format!("IN := {}", self.operand(Of::Plain(from), true))];
                    self.enable(&mut list);
                    self.line(&format!("{from}_TO_{to}({})", list.join(", ")));
                }
                (Of::Plain(to), Of::Plain(from)) => {
                    self.value(Of::Plain(from), depth + 1);
                    self.line(&format!("{from}_TO_{to}"));
                }
                _ => self.load(of),
            },
            6 | 7 => self.standard(of),
            8 => self.function(of, depth),
            _ => self.load(of),
        }
        for _ in 0..self.choices.pick(3) {
            self.step(of, depth);
        }
    }

    /// A function of the file, called in one of the two ways.
    pub fn function(&mut self, of: Of, depth: usize) {
        let functions = self.scope.functions.iter().filter(|unit| unit.result == Some(of)).cloned();
        let functions: Vec<Unit> = functions.collect();
        if functions.is_empty() {
            return self.load(of);
        }
        let unit = &functions[self.choices.pick(functions.len())];
        let in_out = match &unit.in_out {
            Some((_, InOut::One(of))) => self.bound(*of).map(Some),
            Some((_, InOut::Pair)) => self.scope.pairs.first().cloned().map(Some),
            _ => Some(None),
        };
        match in_out {
            Some(in_out) if self.choices.flag() => {
                self.value(unit.inputs[0].1, depth + 1);
                let others = unit.inputs[1..].iter().map(|(_, of)| self.operand(*of, true));
                let others: Vec<String> = others.chain(in_out).collect();
                self.line(format!("{} {}", unit.name, others.join(", ")).trim_end());
            }
            _ => self.enclosed(unit),
        }
    }

    /// A call of a function with all its arguments in parentheses, or a load where it cannot be called.
    fn enclosed(&mut self, unit: &Unit) {
        match self.arguments(unit, true) {
            Some(arguments) => self.line(&format!("{}({arguments})", unit.name)),
            None => self.load(unit.result.unwrap_or(BOOL)),
        }
    }

    /// A standard function, called with all arguments in parentheses.
    fn standard(&mut self, of: Of) {
        let mut arguments: Vec<(&str, Of)> = vec![("IN0", of), ("IN1", of)];
        let small = Of::Plain(Type::new(Kind::Unsigned, 8));
        let word = match self.choices.pick(9) {
            6 if of == BOOL => {
                let of = self.some();
                arguments = vec![("IN1", of), ("IN2", of), ("IN3", of), ("IN4", of)];
                let pair = self.choices.flag() || of == Of::Colour;
                arguments.truncate(if pair { 2 } else { 4 });
                self.choices.of(if of == Of::Colour {
                    &["EQ", "NE"]
                } else if pair {
                    &COMPARISONS
                } else {
                    &COMPARISONS[1..]
                })
            }
            7 if is_bits(of) && of != BOOL => {
                arguments = vec![("IN", of), ("N", small)];
                self.choices.of(&["SHL", "SHR", "ROL", "ROR"])
            }
            8 if is_bits(of) => {
                arguments = vec![("IN", of)];
                "NOT"
            }
            7 if is_integer(of) => {
                arguments = vec![("IN", of)];
                "ABS"
            }
            8 if is_integer(of) => {
                arguments = vec![("IN1", of), ("IN2", of)];
                let Of::Plain(ty) = of else { return self.load(of) };
                let operators = self.operators(ty);
                self.choices.of(operators)
            }
            0 => {
                arguments.insert(0, ("G", BOOL));
                "SEL"
            }
            1 => {
                arguments.insert(0, ("K", Of::Plain(Type::new(Kind::Signed, 8))));
                "MUX"
            }
            2 => {
                arguments = vec![("IN", of)];
                "MOVE"
            }
            3 if of != Of::Colour => {
                arguments = vec![("MN", of), ("IN", of), ("MX", of)];
                "LIMIT"
            }
            4 if is_bits(of) => {
                arguments = vec![("IN1", of), ("IN2", of), ("IN3", of)];
                self.choices.of(&["AND", "OR", "XOR"])
            }
            4 if is_number(of) => {
                arguments = vec![("IN1", of), ("IN2", of)];
                self.choices.of(&["ADD", "SUB"])
            }
            _ if of != Of::Colour => {
                arguments = vec![("IN1", of), ("IN2", of), ("IN3", of)];
                self.choices.of(&["MIN", "MAX"])
            }
            _ => return self.load(of),
        };
        let is_named = is_operator(word) || self.choices.flag();
        let mut list = Vec::new();
        for (name, of) in arguments {
            let value = if is_named && self.choices.pick(6) == 0 { self.list(of) } else { self.operand(of, true) };
            list.push(if is_named { format!("{name} := {value}") } else { value });
        }
        if is_named {
            self.enable(&mut list);
        }
        self.line(&format!("{word}({})", list.join(", ")));
    }

    /// Two values of one type, compared.
    fn comparison(&mut self, depth: usize) {
        let of = self.some();
        self.value(of, depth + 1);
        let operators: &[&str] = if of == Of::Colour { &["EQ", "NE"] } else { &COMPARISONS };
        let operator = self.choices.of(operators);
        if operator != "NE" && self.choices.pick(6) == 0 {
            let (a, b) = (self.operand(of, false), self.operand(of, false));
            return self.line(&format!("{operator} {a}, {b}"));
        }
        self.combine(operator, of, depth);
    }

    /// An operator with an operand or a parenthesis.
    fn combine(&mut self, operator: &str, of: Of, depth: usize) {
        match if depth >= 2 { 2 } else { self.choices.pick(6) } {
            0 => {
                let operand = self.operand(of, false);
                self.line(&format!("{operator}( {operand}"));
                for _ in 0..self.choices.pick(3) {
                    self.step(of, depth + 1);
                }
                self.line(")");
            }
            1 => {
                self.line(&format!("{operator}("));
                self.inner(of, depth + 1);
                self.line(")");
            }
            _ => {
                let operand = self.operand(of, false);
                self.line(&format!("{operator} {operand}"));
            }
        }
    }

    /// The inside of a parenthesis, which begins with a load or a call with all its arguments.
    pub fn inner(&mut self, of: Of, depth: usize) {
        match self.choices.pick(4) {
            0 => self.standard(of),
            1 if self.scope.functions.iter().any(|unit| unit.result == Some(of)) => {
                let functions = self.scope.functions.iter().filter(|unit| unit.result == Some(of)).cloned();
                let functions: Vec<Unit> = functions.collect();
                let unit = &functions[self.choices.pick(functions.len())];
                self.enclosed(unit);
            }
            _ => self.load(of),
        }
        for _ in 0..self.choices.pick(3) {
            self.step(of, depth);
        }
    }

    /// An instruction without parentheses that works on the current result and leaves the same type.
    pub fn simple(&mut self, of: Of) {
        let operand = self.operand(of, false);
        match of {
            Of::Plain(ty) if ty.kind == Kind::Bits => {
                let operator = self.choices.of(&["AND", "ANDN", "OR", "ORN", "XOR", "XORN", "&", "&N"]);
                self.line(&format!("{operator} {operand}"));
            }
            Of::Plain(ty) => {
                let operators: &[&str] = if ty.kind == Kind::Time { &["ADD", "SUB"] } else { self.operators(ty) };
                let operator = self.choices.of(operators);
                self.line(&format!("{operator} {operand}"));
            }
            Of::Colour => {}
        }
    }

    /// Multiplication and division are large: not of every wide type.
    fn operators(&mut self, ty: Type) -> &'static [&'static str] {
        let large = ty.width <= 8 || self.choices.pick(usize::try_from(ty.width).unwrap_or(64)) == 0;
        if large { &["ADD", "SUB", "MUL", "DIV", "MOD"] } else { &["ADD", "SUB"] }
    }

    /// An instruction that works on the current result and leaves the same type.
    fn step(&mut self, of: Of, depth: usize) {
        match (self.choices.pick(8), of) {
            (_, Of::Colour) => {}
            (0, _) if is_bits(of) => self.line("NOT"),
            (0, Of::Plain(ty)) if ty.kind != Kind::Time => self.line("ABS"),
            (1, Of::Plain(ty)) if is_bits(of) && !ty.is_bool() => {
                let operator = self.choices.of(&["SHL", "SHR", "ROL", "ROR"]);
                let short = Of::Plain(Type::new(Kind::Unsigned, 8));
                let distance = match self.choices.pick(3) {
                    0 => self.operand(short, true),
                    _ => self.choices.pick(ty.width as usize + 2).to_string(),
                };
                self.line(&format!("{operator} {distance}"));
            }
            (2, _) => {
                let (word, a, b) =
                    (self.choices.of(&["MIN", "MAX", "LIMIT"]), self.operand(of, false), self.operand(of, false));
                self.line(&format!("{word} {a}, {b}"));
            }
            (3, Of::Plain(ty)) if is_integer(of) && ty.width == 8 => {
                let (a, b) = (self.operand(of, false), self.operand(of, false));
                self.line(&format!("MUX {a}, {b}"));
            }
            (3, _) if of == BOOL => {
                let (a, b) = (self.operand(of, false), self.operand(of, false));
                self.line(&format!("SEL {a}, {b}"));
            }
            (4 | 5, Of::Plain(ty)) => {
                let operators: &[&str] = match ty.kind {
                    Kind::Bits => &["AND", "ANDN", "OR", "ORN", "XOR", "XORN", "&"],
                    Kind::Time => &["ADD", "SUB"],
                    _ => self.operators(ty),
                };
                let operator = self.choices.of(operators);
                self.combine(operator, of, depth);
            }
            _ => self.simple(of),
        }
    }
}

/// Only `NE` does not take more than two values.
const COMPARISONS: [&str; 6] = ["NE", "GT", "GE", "EQ", "LE", "LT"];

fn is_integer(of: Of) -> bool {
    matches!(of, Of::Plain(ty) if matches!(ty.kind, Kind::Signed | Kind::Unsigned))
}

fn is_number(of: Of) -> bool {
    matches!(of, Of::Plain(ty) if ty.kind != Kind::Bits)
}

/// Whether a function has the name of an operator, and is told from it by the names of its arguments.
fn is_operator(word: &str) -> bool {
    !matches!(word, "SEL" | "MUX" | "MOVE" | "LIMIT" | "MIN" | "MAX" | "ABS")
}
