//! Random texts over the whole language: all types, functions, function blocks in each other, standard function blocks,
//! arrays, structures, enumerations, subranges, global variables and addresses. What a body is made of is in
//! `random_wide_body`.

use petril::semantics::{Kind, Type};

use super::random_flat::Choices;
use super::random_wide_blocks::standard;
use super::random_wide_body::body;

/// The type of an elementary value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Plain(Type),
    Colour,
}

pub const BOOL: Of = Of::Plain(Type::BOOL);
pub const COLOURS: [&str; 3] = ["Red", "Green", "Blue"];
pub const PLAIN_INT: Of = Of::Plain(Type::new(Kind::Signed, 16));

impl Of {
    pub fn name(self) -> String {
        match self {
            Self::Plain(ty) => ty.to_string(),
            Self::Colour => "Colour".to_owned(),
        }
    }
}

/// A variable that can be named, or the elements of one.
#[derive(Clone, Debug)]
pub struct Entry {
    pub base: String,
    /// One list for each pair of brackets.
    pub ranges: Vec<Vec<(i64, i64)>>,
    pub member: String,
    pub of: Of,
    /// Whether it may be written.
    pub written: bool,
    /// Whether it is of exactly the type, no subrange of it.
    pub whole: bool,
}

/// A function or function block.
#[derive(Clone, Debug)]
pub struct Unit {
    pub name: String,
    /// The result of a function.
    pub result: Option<Of>,
    pub inputs: Vec<(String, Of)>,
    pub outputs: Vec<(String, Of)>,
    pub in_out: Option<(String, InOut)>,
}

#[derive(Clone, Copy, Debug)]
pub enum InOut {
    One(Of),
    /// `ARRAY [0..3] OF SINT`
    Row,
    /// A structure.
    Pair,
    /// `CTU`
    Counter,
}

/// What a body can name.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    pub entries: Vec<Entry>,
    /// Instances and what they are instances of.
    pub instances: Vec<(String, Unit)>,
    pub functions: Vec<Unit>,
    /// Variables of the type that [`InOut::Row`] takes.
    pub rows: Vec<String>,
    /// Variables of the type that [`InOut::Pair`] takes.
    pub pairs: Vec<String>,
    /// `VAR … END_VAR` of loops, as many as the body needs.
    pub loops: usize,
    /// Whether values are only moved, so that variables need few bits.
    pub plain: bool,
}

impl Scope {
    fn entry(&mut self, base: &str, of: Of, written: bool) {
        let (ranges, member) = (Vec::new(), String::new());
        self.entries.push(Entry { base: base.to_owned(), ranges, member, of, written, whole: true });
    }

    fn instance(&mut self, name: &str, unit: &Unit) {
        unit.inputs.iter().for_each(|(input, of)| self.entry(&format!("{name}.{input}"), *of, true));
        unit.outputs.iter().for_each(|(output, of)| self.entry(&format!("{name}.{output}"), *of, false));
        self.instances.push((name.to_owned(), unit.clone()));
    }
}

/// A literal of a type, which says its type if it is `anchored`.
pub fn literal(choices: &mut Choices<'_>, of: Of, anchored: bool) -> String {
    let Of::Plain(ty) = of else {
        let value = choices.of(&COLOURS);
        return if anchored || choices.flag() { format!("Colour#{value}") } else { value.to_owned() };
    };
    let pattern = choices.pattern(ty);
    let number = ty.number(pattern);
    match ty.kind {
        _ if ty.is_bool() => if pattern == 1 { "TRUE" } else { "FALSE" }.to_owned(),
        // Often a few scans.
        Kind::Time if choices.flag() => format!("T#{}ms", choices.of(&[0, 10, 20, 21, 30, 40, 41, 256])),
        Kind::Time => format!("{}#{number}ms", choices.of(&["T", "TIME", "t"])),
        Kind::Bits if anchored => format!("{ty}#16#{pattern:X}"),
        Kind::Bits => match choices.pick(3) {
            0 => format!("16#{pattern:x}"),
            1 => format!("2#{pattern:b}"),
            _ => number.to_string(),
        },
        _ if anchored => format!("{ty}#{number}"),
        _ => number.to_string(),
    }
}

/// A program text.
pub fn text(choices: &mut Choices<'_>) -> String {
    let (element, other) = (choices.ty(), choices.ty());
    let mut text = format!(
        "TYPE\nColour : (Red, Green, Blue){};\nLevel : INT (-5..20) := {};\nRow : ARRAY [0..3] OF SINT := [1, 2(-3)];\n\
         Pair : STRUCT n : {element}; b : BOOL := TRUE; c : Colour := Blue; l : Level; m : ARRAY [0..1] OF {other}; \
         END_STRUCT;\nEND_TYPE\n",
        choices.of(&["", " := Green"]),
        choices.pick(20),
    );
    let global = Of::Plain(choices.ty());
    text += &format!("VAR_GLOBAL g0 : {} := {}; END_VAR\n", global.name(), literal(choices, global, false));
    text += "VAR_GLOBAL shared : Pair := (l := 7); END_VAR\n";
    text += "VAR_GLOBAL late : TON; END_VAR\nVAR_GLOBAL CONSTANT limit : USINT := 3; END_VAR\n";
    let plain = choices.pick(4) == 0;
    let mut making = Making { choices, plain, types: [element, other].map(Of::Plain), global, units: Vec::new() };
    for number in 0..making.choices.pick(3) {
        text += &making.function(number);
    }
    for number in 0..making.choices.pick(3) {
        text += &making.block(number);
    }
    text += &making.program();
    if making.choices.pick(4) == 0 {
        text += "CONFIGURATION plc TASK often (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM one WITH often : random; \
                 END_CONFIGURATION\n";
    }
    text
}

struct Making<'c, 'n> {
    choices: &'c mut Choices<'n>,
    plain: bool,
    /// Of the members `n` and `m` of a `Pair`.
    types: [Of; 2],
    global: Of,
    units: Vec<Unit>,
}

impl Making<'_, '_> {
    fn of(&mut self) -> Of {
        match self.choices.pick(10) {
            0..3 => BOOL,
            3 => Of::Colour,
            _ => Of::Plain(self.choices.ty()),
        }
    }

    /// What units may call.
    fn scope(&self) -> Scope {
        let functions = self.units.iter().filter(|unit| unit.result.is_some()).cloned().collect();
        Scope { functions, plain: self.plain, ..Scope::default() }
    }

    /// `VAR_INPUT x0 : INT; … END_VAR`
    fn variables(
        &mut self,
        kind: &str,
        names: &[String],
        scope: &mut Scope,
        written: bool,
    ) -> (String, Vec<(String, Of)>) {
        let mut text = String::new();
        let mut list = Vec::new();
        for name in names {
            let of = self.of();
            let given = kind == "VAR CONSTANT" || (kind != "VAR_IN_OUT" && self.choices.pick(3) == 0);
            let initial = if given { format!(" := {}", literal(self.choices, of, false)) } else { String::new() };
            if of == PLAIN_INT && kind != "VAR_IN_OUT" && self.choices.flag() {
                let initial = if given { format!(" := {}", self.choices.pick(20)) } else { String::new() };
                text += &format!("{name} : Level{initial}; ");
                scope.subrange(name, Vec::new(), "");
                scope.entries.iter_mut().last().into_iter().for_each(|entry| entry.written = written);
            } else {
                text += &format!("{name} : {}{initial}; ", of.name());
                scope.entry(name, of, written);
            }
            list.push((name.clone(), of));
        }
        (format!("{kind} {text}END_VAR\n"), list)
    }

    fn names(&mut self, stem: &str, least: usize, most: usize) -> Vec<String> {
        (0..least + self.choices.pick(most - least + 1)).map(|i| format!("{stem}{i}")).collect()
    }

    fn function(&mut self, number: usize) -> String {
        let name = format!("func{number}");
        let result = self.of();
        let mut scope = self.scope();
        let inputs = self.names("x", 1, 2);
        let (head, inputs) = self.variables("VAR_INPUT", &inputs, &mut scope, false);
        let outputs = self.names("y", 0, 1);
        let (out, outputs) = self.variables("VAR_OUTPUT", &outputs, &mut scope, true);
        let locals = self.names("z", 0, 1);
        let (own, _) = self.variables("VAR", &locals, &mut scope, true);
        let mut own = own;
        let temporary = self.names("t", 0, 1);
        own += &self.variables("VAR_TEMP", &temporary, &mut scope, true).0;
        let in_out = match self.choices.pick(6) {
            0 | 1 => {
                let of = self.of();
                own += &format!("VAR_IN_OUT w : {}; END_VAR\n", of.name());
                scope.entry("w", of, true);
                Some(("w".to_owned(), InOut::One(of)))
            }
            2 => Some(self.pair_in_out(&mut scope, &mut own)),
            _ => None,
        };
        own += &self.composite(&mut scope, 12);
        let is_subrange = result == PLAIN_INT && self.choices.flag();
        if is_subrange {
            scope.subrange(&name, Vec::new(), "");
        } else {
            scope.entry(&name, result, true);
        }
        let body = body(self.choices, &mut scope, 2);
        self.units.push(Unit { name: name.clone(), result: Some(result), inputs, outputs, in_out });
        let result = if is_subrange { "Level".to_owned() } else { result.name() };
        format!("FUNCTION {name} : {result}\n{head}{out}{own}{}{body}END_FUNCTION\n", loops(&scope))
    }

    fn block(&mut self, number: usize) -> String {
        let name = format!("block{number}");
        let mut scope = self.scope();
        let inputs = if self.choices.flag() { self.names("x", 1, 2) } else { vec!["IN".to_owned(), "R".to_owned()] };
        let (head, inputs) = self.variables("VAR_INPUT", &inputs, &mut scope, false);
        let outputs = self.names("y", 1, 2);
        let (out, outputs) = self.variables("VAR_OUTPUT", &outputs, &mut scope, true);
        let (own, temporary) = (self.names("z", 0, 2), self.names("t", 0, 1));
        let (mut own, _) = self.variables("VAR", &own, &mut scope, true);
        own += &self.variables("VAR_TEMP", &temporary, &mut scope, true).0;
        let in_out = match self.choices.pick(6) {
            3 => Some(self.pair_in_out(&mut scope, &mut own)),
            2 => {
                own += "VAR_IN_OUT w : CTU; END_VAR\n";
                standard().iter().filter(|unit| unit.name == "CTU").for_each(|unit| scope.instance("w", unit));
                Some(("w".to_owned(), InOut::Counter))
            }
            0 => {
                let of = self.of();
                own += &format!("VAR_IN_OUT w : {}; END_VAR\n", of.name());
                scope.entry("w", of, true);
                Some(("w".to_owned(), InOut::One(of)))
            }
            1 => {
                own += "VAR_IN_OUT w : Row; END_VAR\n";
                scope.row("w");
                Some(("w".to_owned(), InOut::Row))
            }
            _ => None,
        };
        own += &self.composite(&mut scope, 8);
        own += &self.instances(&mut scope);
        let body = body(self.choices, &mut scope, 3);
        self.units.push(Unit { name: name.clone(), result: None, inputs, outputs, in_out });
        format!("FUNCTION_BLOCK {name}\n{head}{out}{own}{}{body}END_FUNCTION_BLOCK\n", loops(&scope))
    }

    fn program(&mut self) -> String {
        let mut scope = self.scope();
        let (inputs, outputs) = (self.names("i", 1, 3), self.names("o", 1, 2));
        let mut text = self.variables("VAR_INPUT", &inputs, &mut scope, false).0;
        text += &self.variables("VAR_OUTPUT", &outputs, &mut scope, true).0;
        let (own, constants) = (self.names("v", 1, 3), self.names("k", 0, 1));
        text += &self.variables("VAR", &own, &mut scope, true).0;
        text += &self.variables("VAR CONSTANT", &constants, &mut scope, false).0;
        let temporary = self.names("t", 0, 1);
        text += &self.variables("VAR_TEMP", &temporary, &mut scope, true).0;
        text += &self.composite(&mut scope, 5);
        text += &self.instances(&mut scope);
        if self.units.iter().any(|unit| matches!(unit.in_out, Some((_, InOut::Pair)))) {
            text += "VAR both : Pair := (b := FALSE); END_VAR\n";
            self.members("both", &[], &mut scope);
            scope.pairs.insert(0, "both".to_owned());
        }
        if self.choices.pick(4) == 0 {
            scope.entry("%IX0.3", BOOL, false);
            scope.entry("%QB4", Of::Plain(Type::new(Kind::Bits, 8)), true);
            text += "VAR mem AT %MW6 : WORD := 16#12; lamp AT %QX9.1 : BOOL; key AT %IX2.0 : BOOL; END_VAR\n";
            scope.entry("mem", Of::Plain(Type::new(Kind::Bits, 16)), true);
            scope.entry("lamp", BOOL, true);
            scope.entry("key", BOOL, false);
        }
        if self.choices.pick(4) == 0 {
            text += "VAR_EXTERNAL limit : USINT; END_VAR\nVAR CONSTANT few : USINT := 2; END_VAR\n\
                     VAR RETAIN kept : USINT := few; END_VAR\n";
            let small = Of::Plain(Type::new(Kind::Unsigned, 8));
            for (name, written) in [("limit", false), ("few", false), ("kept", true)] {
                scope.entry(name, small, written);
            }
        }
        let mut compared = String::new();
        if self.choices.pick(3) == 0 {
            text += "VAR_INPUT gauge : SINT; END_VAR VAR_OUTPUT high : BOOL; END_VAR\n";
            let (operator, number) = (self.choices.of(&["GT", "GE", "EQ", "NE", "LE", "LT"]), self.choices.pick(8));
            compared = match self.choices.flag() {
                true => format!("LD gauge\n{operator} {number}\nST high\n"),
                false => format!("LD SINT#{number}\n{operator} gauge\nST high\n"),
            };
        }
        let body = compared + &body(self.choices, &mut scope, 5);
        format!("PROGRAM random\n{text}{}{body}END_PROGRAM\n", loops(&scope))
    }

    /// Arrays, structures, subranges and global variables, each in one of `rarity` programs.
    fn composite(&mut self, scope: &mut Scope, rarity: usize) -> String {
        let mut text = String::new();
        if self.choices.pick(rarity) == 0 {
            let of = self.of();
            let (lower, length) = (self.choices.pick(5) as i64 - 2, 1 + self.choices.pick(4) as i64);
            let upper = lower + length - 1;
            let value = literal(self.choices, of, false);
            text += &format!("VAR row : ARRAY [{lower}..{upper}] OF {} := [{length}({value})]; END_VAR\n", of.name());
            scope.elements("row", vec![vec![(lower, upper)]], "", of);
        }
        if self.choices.pick(rarity) == 0 {
            let of = self.of();
            let ranges =
                if self.choices.flag() { vec![vec![(0, 1), (1, 2)]] } else { vec![vec![(0, 1)], vec![(1, 2)]] };
            let written = if ranges.len() == 1 { "ARRAY [0..1, 1..2]" } else { "ARRAY [0..1] OF ARRAY [1..2]" };
            text += &format!("VAR grid : {written} OF {}; END_VAR\n", of.name());
            scope.elements("grid", ranges, "", of);
        }
        if self.choices.pick(rarity) == 0 {
            text += "VAR pair : Pair := (b := FALSE, l := -5); END_VAR\n";
            self.members("pair", &[], scope);
            scope.pairs.push("pair".to_owned());
        }
        if self.choices.pick(rarity) == 0 {
            text += "VAR_EXTERNAL shared : Pair; END_VAR\n";
            self.members("shared", &[], scope);
            scope.pairs.push("shared".to_owned());
        }
        if self.choices.pick(rarity) == 0 {
            text += "VAR pairs : ARRAY [-1..1] OF Pair := [(c := Red), 2((l := 20))]; END_VAR\n";
            self.members("pairs", &[vec![(-1, 1)]], scope);
        }
        if self.choices.pick(rarity) == 0 {
            text += "VAR level : Level; END_VAR\n";
            scope.subrange("level", Vec::new(), "");
        }
        if self.choices.pick(rarity) == 0 {
            text += &format!("VAR_EXTERNAL g0 : {}; END_VAR\n", self.global.name());
            scope.entry("g0", self.global, true);
        }
        text
    }

    /// A structure that a unit is given to change.
    fn pair_in_out(&mut self, scope: &mut Scope, own: &mut String) -> (String, InOut) {
        *own += "VAR_IN_OUT w : Pair; END_VAR\n";
        self.members("w", &[], scope);
        scope.pairs.push("w".to_owned());
        ("w".to_owned(), InOut::Pair)
    }

    /// The global timer, named in one of six units.
    fn late(&mut self, scope: &mut Scope) -> String {
        if self.choices.pick(6) > 0 {
            return String::new();
        }
        standard().iter().filter(|unit| unit.name == "TON").for_each(|unit| scope.instance("late", unit));
        "VAR_EXTERNAL late : TON; END_VAR\n".to_owned()
    }

    fn members(&self, base: &str, ranges: &[Vec<(i64, i64)>], scope: &mut Scope) {
        for (member, of) in [(".n", self.types[0]), (".b", BOOL), (".c", Of::Colour)] {
            scope.elements(base, ranges.to_vec(), member, of);
        }
        scope.subrange(base, ranges.to_vec(), ".l");
        let position = usize::from(!ranges.is_empty());
        scope.elements(base, ranges.to_vec(), &format!(".m[{position}]"), self.types[1]);
    }

    /// Instances of the function blocks so far and of those of the standard.
    fn instances(&mut self, scope: &mut Scope) -> String {
        let mut text = self.late(scope);
        for unit in self.units.clone().iter().filter(|unit| unit.result.is_none()) {
            if self.choices.flag() {
                if self.choices.pick(4) == 0 {
                    text += &format!("VAR all_{0} : ARRAY [1..2] OF {0}; END_VAR\n", unit.name);
                    scope.instance(&format!("all_{}[2]", unit.name), unit);
                }
                let initial = match &unit.inputs[0] {
                    (input, of) if *of != PLAIN_INT && self.choices.pick(3) == 0 => {
                        format!(" := ({input} := {})", literal(self.choices, *of, false))
                    }
                    _ => String::new(),
                };
                text += &format!("VAR of_{0} : {0}{initial}; END_VAR\n", unit.name);
                scope.instance(&format!("of_{}", unit.name), unit);
                if let Some((_, InOut::Counter)) = unit.in_out
                    && scope.instances.iter().all(|(name, _)| name != "counter")
                {
                    text += "VAR counter : CTU; END_VAR\n";
                    standard()
                        .iter()
                        .filter(|unit| unit.name == "CTU")
                        .for_each(|unit| scope.instance("counter", unit));
                }
                if let Some((_, InOut::Row)) = unit.in_out
                    && scope.rows.iter().all(|row| row != "sints")
                {
                    text += "VAR sints : Row := [4(5)]; END_VAR\n";
                    scope.row("sints");
                }
            }
        }
        if self.choices.pick(8) == 0 {
            text += "VAR delays : ARRAY [1..2] OF TON; END_VAR\n";
            standard().iter().filter(|unit| unit.name == "TON").for_each(|unit| scope.instance("delays[2]", unit));
        }
        if self.choices.pick(3) == 0 {
            let units = standard();
            let unit = &units[self.choices.pick(units.len())];
            text += &format!("VAR std : {}; END_VAR\n", unit.name);
            scope.instance("std", unit);
        }
        text
    }
}

impl Scope {
    fn elements(&mut self, base: &str, ranges: Vec<Vec<(i64, i64)>>, member: &str, of: Of) {
        let (base, member) = (base.to_owned(), member.to_owned());
        self.entries.push(Entry { base, ranges, member, of, written: true, whole: true });
    }

    fn subrange(&mut self, base: &str, ranges: Vec<Vec<(i64, i64)>>, member: &str) {
        self.elements(base, ranges, member, PLAIN_INT);
        self.entries.iter_mut().last().into_iter().for_each(|entry| entry.whole = false);
    }

    fn row(&mut self, name: &str) {
        self.elements(name, vec![vec![(0, 3)]], "", Of::Plain(Type::new(Kind::Signed, 8)));
        self.rows.push(name.to_owned());
    }
}

fn loops(scope: &Scope) -> String {
    (0..scope.loops).map(|i| format!("VAR turn{i} : USINT; END_VAR\n")).collect()
}
