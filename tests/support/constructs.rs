//! The constructs of the language that a checked program uses, by name. The matches name every variant, so that a new one
//! does not compile before it has a name here.

use std::collections::BTreeSet;

use petril::semantics::{
    Action, Area, Call, Callee, Condition, Enable, Feed, FeedSource, Index, Kind, Operand, Place, Pou, PouKind,
    Program, Root, Section, Shape, Standard, StandardFunction, Statement, Step, Type, Value, Variable,
};

/// Adds the constructs of a program.
pub fn of_program(program: &Program, found: &mut BTreeSet<String>) {
    program.globals.iter().for_each(|variable| of_variable("global", variable, found));
    if program.interval.is_some() {
        found.insert("task".to_owned());
    }
    for pou in program.pous.values() {
        let unit = match pou.kind {
            PouKind::Program => "program",
            PouKind::Function => "function",
            PouKind::FunctionBlock => "block",
        };
        if pou.is_library {
            found.insert(format!("library {}", pou.name));
            continue;
        }
        pou.variables.iter().for_each(|variable| of_variable(unit, variable, found));
        Walk { program, pou, unit, found }.list(&pou.body, "");
    }
}

fn of_variable(unit: &str, variable: &Variable, found: &mut BTreeSet<String>) {
    let section = match variable.section {
        Section::Input => "input",
        Section::Output => "output",
        Section::InOut => "in-out",
        Section::Local => "local",
        Section::Temp => "temporary",
        Section::Constant => "constant",
        Section::Result => "result",
        Section::External(_) => "external",
    };
    found.insert(format!("{unit} {section}"));
    let shape = of_shape(&variable.shape, found);
    found.insert(format!("{section} {shape}"));
    match variable.area {
        None => {}
        Some(Area::Input) => drop(found.insert("address of an input".to_owned())),
        Some(Area::Output) => drop(found.insert("address of an output".to_owned())),
        Some(Area::Memory) => drop(found.insert("address of memory".to_owned())),
    }
    let initial = match variable.initial {
        Value::Default => "default",
        Value::Scalar(_) => "value",
        Value::Parts(_) => "values of parts",
    };
    found.insert(format!("initial {initial}"));
}

fn of_shape(shape: &Shape, found: &mut BTreeSet<String>) -> &'static str {
    match shape {
        Shape::Scalar(scalar) if scalar.enumeration.is_some() => "enumeration",
        Shape::Scalar(scalar) if scalar.range.is_some() => "subrange",
        Shape::Scalar(scalar) => {
            found.insert(scalar.ty.to_string());
            "value"
        }
        Shape::Array { of, .. } => {
            let inner = of_shape(of, found);
            found.insert(format!("array of {inner}"));
            "array"
        }
        Shape::Structure(structure) => {
            for member in &structure.members {
                let inner = of_shape(&member.shape, found);
                found.insert(format!("member {inner}"));
            }
            "structure"
        }
        Shape::Instance(_) => "instance",
    }
}

struct Walk<'p, 'f> {
    program: &'p Program,
    pou: &'p Pou,
    unit: &'static str,
    found: &'f mut BTreeSet<String>,
}

impl Walk<'_, '_> {
    fn add(&mut self, name: impl Into<String>) {
        self.found.insert(name.into());
    }

    /// The instructions of a unit, or of what stands in it ("list", "parenthesis").
    fn list(&mut self, body: &[Statement], inside: &str) {
        for (at, statement) in body.iter().enumerate() {
            self.statement(&statement.action, at, inside);
        }
    }

    fn statement(&mut self, action: &Action, at: usize, inside: &str) {
        let not = |negated: bool| if negated { " negated" } else { "" };
        match action {
            Action::Load { negated, operand, .. } => {
                self.add(format!("load{}", not(*negated)));
                self.operand(operand);
            }
            Action::Store { negated, place, .. } => {
                self.add(format!("store{}", not(*negated)));
                self.place(place, "store");
            }
            Action::Set(place) => {
                self.add("set");
                self.place(place, "set");
            }
            Action::Reset(place) => {
                self.add("reset");
                self.place(place, "reset");
            }
            Action::Complement(_) => self.add("complement"),
            Action::Combine { function, ty, negated, operand } => {
                let kind = kind(self.pou.types[ty.0]);
                self.add(format!("{function:?} {kind}{}", not(*negated)));
                self.operand(operand);
            }
            Action::Defer { function, negated, body, .. } => {
                self.add(format!("{function:?}({}", not(*negated)));
                if !inside.is_empty() {
                    self.add(format!("parenthesis in {inside}"));
                }
                self.list(body, "parenthesis");
            }
            Action::Jump(condition, target) => {
                let way = if *target <= at { "back" } else { "on" };
                self.add(format!("jump {way} {}", conditional(*condition)));
            }
            Action::Return(condition) => self.add(format!("return from {} {}", self.unit, conditional(*condition))),
            Action::Call(call) => self.call(call, inside),
            Action::Standard(standard) => self.standard(standard, inside),
        }
    }

    fn call(&mut self, call: &Call, inside: &str) {
        let (callee, id) = match &call.callee {
            Callee::Instance(id, place) => {
                self.place(place, "instance");
                ("instance", id)
            }
            Callee::Function(id) => ("function", id),
        };
        self.add(format!("call of {callee} {} in {}", conditional(call.condition), self.unit));
        if !inside.is_empty() {
            self.add(format!("call of {callee} in {inside}"));
        }
        if call.result_to.is_some() {
            self.add("input operator");
        }
        call.inputs.iter().for_each(|(_, feed)| self.feed(feed, callee));
        for (_, place) in &call.in_outs {
            let mut shapes = BTreeSet::new();
            self.add(format!("in-out of {callee}: {}", of_shape(&place.shape, &mut shapes)));
            self.place(place, "in-out");
        }
        for (_, negated, place) in &call.outputs {
            self.add(format!("output of {callee}{}", if *negated { " negated" } else { "" }));
            self.place(place, "output");
        }
        let inputs =
            self.program.pous[id].variables.iter().filter(|variable| variable.section == Section::Input).count();
        if call.inputs.len() + usize::from(call.result_to.is_some()) < inputs {
            self.add(format!("input of {callee} left out"));
        }
        self.enable(&call.enable, callee);
        if call.enable.eno.is_some() && !call.outputs.is_empty() {
            let order = if call.before_eno == call.outputs.len() { "last" } else { "before an output" };
            self.add(format!("ENO {order}"));
        }
    }

    fn standard(&mut self, standard: &Standard, inside: &str) {
        let name = match standard.function {
            StandardFunction::Convert
            | StandardFunction::Move
            | StandardFunction::Not
            | StandardFunction::Abs
            | StandardFunction::Min
            | StandardFunction::Max
            | StandardFunction::Limit
            | StandardFunction::Sel
            | StandardFunction::Mux
            | StandardFunction::Fold(_)
            | StandardFunction::Chain(_) => format!("{:?}", standard.function),
        };
        let first = standard.arguments.first().map(|feed| &feed.source);
        let form = if matches!(first, Some(FeedSource::Result)) { " of the current result" } else { "(…)" };
        self.add(name + form);
        if !inside.is_empty() {
            self.add(format!("standard function in {inside}"));
        }
        standard.arguments.iter().for_each(|feed| self.feed(feed, "standard"));
        self.enable(&standard.enable, "standard");
    }

    fn enable(&mut self, enable: &Enable, callee: &str) {
        let Enable { en, eno } = enable;
        if let Some(en) = en {
            self.add(format!("EN of {callee}"));
            self.feed(en, "EN");
        }
        if let Some((negated, place)) = eno {
            self.add(format!("ENO of {callee}{}", if *negated { " negated" } else { "" }));
            self.place(place, "ENO");
        }
    }

    fn feed(&mut self, feed: &Feed, callee: &str) {
        match &feed.source {
            FeedSource::Result => self.add(format!("current result to {callee}")),
            FeedSource::Operand(operand) => {
                self.add(format!("operand to {callee}"));
                self.operand(operand);
            }
            FeedSource::List(list) => {
                self.add(format!("list to {callee}"));
                self.list(list, "list");
            }
        }
    }

    fn operand(&mut self, operand: &Operand) {
        match operand {
            Operand::Literal(_) => self.add("literal"),
            Operand::Place(place) => self.place(place, "read"),
        }
    }

    fn place(&mut self, place: &Place, how: &str) {
        match place.root {
            Root::Own(_) => self.add("own variable"),
            Root::Global(_) => self.add("global variable"),
        }
        for step in &place.steps {
            match step {
                Step::Member(_) => self.add(format!("{how} of a member")),
                Step::Index(indices) => {
                    let variable = indices.iter().filter(|index| matches!(index, Index::Variable(_))).count();
                    self.add(format!("{how} at {variable} of {} indices", indices.len()));
                }
            }
        }
    }
}

fn kind(ty: Type) -> &'static str {
    match ty.kind {
        _ if ty.is_bool() => "Boolean",
        Kind::Bits => "bits",
        Kind::Signed => "signed",
        Kind::Unsigned => "unsigned",
        Kind::Time => "time",
    }
}

fn conditional(condition: Condition) -> &'static str {
    match condition {
        Condition::Always => "always",
        Condition::IfTrue => "if TRUE",
        Condition::IfFalse => "if FALSE",
    }
}
