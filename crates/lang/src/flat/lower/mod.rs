//! Lowering of a checked program to flat code: calls inlined, parentheses buffered, labels resolved.

mod buffers;
mod calls;
mod layout;
mod places;
mod standard;
mod statements;
mod timers;

use std::collections::{BTreeMap, BTreeSet};

use super::narrow::{Timer, narrow};
use super::{FlatProgram, Instruction, Line, Operand, Restriction, Target, Variable};
use crate::semantics::{self, Condition, Pou, PouId, PouKind, Program, Role, Section, Shape, Type, VarId};
use buffers::Buffers;
use layout::{Layouts, Leaf};
use petril_base::source::Span;
use places::Address;

/// Scan time in milliseconds, if neither a task nor the user gives it.
pub const DEFAULT_SCAN_TIME: u64 = 20;

/// Flattens a program; the scan time is the interval of its task.
#[must_use]
pub fn flatten(program: &Program) -> FlatProgram {
    flatten_with(program, None)
}

/// Flattens a program with a scan time in milliseconds, if one is given.
///
/// A call becomes the instructions of the called unit, on variables of its own: `t.Q` is the output of the instance
/// `t`. A return becomes a jump after them. `AND( x … )` becomes `ST A`, `LD x`, …, `ST B`, `LD A`, `AND B`.
#[must_use]
pub fn flatten_with(program: &Program, scan_time: Option<u64>) -> FlatProgram {
    let mut lowering = Lowering::new(program, scan_time.or(program.interval).unwrap_or(DEFAULT_SCAN_TIME));
    let entry = lowering.allocate();
    let has_timers = lowering.ticks();
    lowering.begin(&entry);
    lowering.body(&entry);
    lowering.place_label(entry.exit);
    lowering.resolve();
    let cycle = lowering.scan_time;
    let scan_time = has_timers.then_some(cycle);
    let name = program.pous[&program.entry].name.clone();
    let Lowering { variables, code, restrictions, addresses, internal, timers, .. } = lowering;
    let mut flat =
        FlatProgram { name, variables, code, restrictions, addresses, internal, scan_time, cycle, presets_vary: false };
    narrow(&mut flat, &timers);
    flat
}

/// Line that is not known yet, as a position in [`Lowering::labels`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Label(usize);

/// Unit whose instructions are being lowered, for one call.
struct Frame<'p> {
    pou: &'p Pou,
    /// Address of each variable of the unit; `None` if nothing can name it.
    variables: Vec<Option<Address>>,
    /// Number of parentheses around the call whose left operands are in buffers meanwhile.
    depth: usize,
    /// Label that a return jumps to.
    exit: Label,
    /// Source of all lines of the unit, if they have no text of their own.
    span: Option<Span>,
}

struct Lowering<'p> {
    program: &'p Program,
    layouts: Layouts<'p>,
    scan_time: u64,
    variables: Vec<Variable>,
    restrictions: BTreeMap<VarId, Restriction>,
    addresses: BTreeMap<String, VarId>,
    internal: BTreeSet<VarId>,
    code: Vec<Line>,
    /// Line of each label. Until the end, a jump's target is a label.
    labels: Vec<usize>,
    buffers: Buffers,
    globals: Vec<Address>,
    timers: Vec<Timer>,
}

impl<'p> Lowering<'p> {
    fn new(program: &'p Program, scan_time: u64) -> Self {
        Self {
            program,
            layouts: Layouts::new(program),
            scan_time,
            variables: Vec::new(),
            restrictions: BTreeMap::new(),
            addresses: BTreeMap::new(),
            internal: BTreeSet::new(),
            code: Vec::new(),
            labels: Vec::new(),
            buffers: Buffers::default(),
            globals: Vec::new(),
            timers: Vec::new(),
        }
    }

    fn pou(&self, id: PouId) -> &'p Pou {
        &self.program.pous[&id]
    }

    /// Adds the declared variables: those of the program, then the global ones.
    fn allocate(&mut self) -> Frame<'p> {
        let pou = self.pou(self.program.entry);
        let mut variables = Vec::new();
        for variable in &pou.variables {
            let role = match (variable.section, variable.area) {
                (Section::Temp, _) => Role::Buffer,
                (Section::Result, _) => Role::Output,
                (section, area) => layout::role(section, area),
            };
            let stored = !matches!(variable.section, Section::External(_) | Section::InOut | Section::Temp);
            if stored {
                self.locate(variable);
            }
            let address = stored.then(|| {
                let leaf = Leaf { name: variable.name.clone(), role, span: variable.span };
                self.variables_of(&leaf, &variable.shape, &variable.initial)
            });
            variables.push(address);
        }
        for variable in &self.program.globals {
            let role = layout::role(variable.section, variable.area);
            self.locate(variable);
            let leaf = Leaf { name: variable.name.clone(), role, span: variable.span };
            let address = self.variables_of(&leaf, &variable.shape, &variable.initial);
            self.globals.push(address);
        }
        // Buffers come after all declared variables.
        for (position, variable) in pou.variables.iter().enumerate() {
            if variable.section == Section::Temp {
                let leaf = Leaf { name: self.unused(&variable.name), role: Role::Buffer, span: variable.span };
                variables[position] = Some(self.variables_of(&leaf, &variable.shape, &variable.initial));
            }
        }
        Frame { pou, variables, depth: 0, exit: self.label(), span: None }
    }

    /// Records the address of the elementary variable that is added next.
    fn locate(&mut self, variable: &semantics::Variable) {
        if let (Some(address), Shape::Scalar(_)) = (&variable.address, &variable.shape) {
            self.addresses.insert(address.clone(), VarId(self.variables.len()));
        }
    }

    /// Initialises the variables that are initialised in every scan.
    fn begin(&mut self, entry: &Frame<'p>) {
        let anew = |section| match entry.pou.kind {
            PouKind::Function => matches!(section, Section::Temp | Section::Local | Section::Output | Section::Result),
            _ => section == Section::Temp,
        };
        let positions: Vec<usize> =
            (0..entry.pou.variables.len()).filter(|&i| anew(entry.pou.variables[i].section)).collect();
        for position in positions {
            self.initialise(entry, position, entry.pou.variables[position].span);
        }
    }

    fn emit(&mut self, instruction: Instruction, span: Span) {
        self.code.push(Line { instruction, span });
    }

    fn load(&mut self, ty: Type, operand: Operand, span: Span) {
        self.emit(Instruction::Load { ty, negated: false, operand }, span);
    }

    fn load_variable(&mut self, ty: Type, variable: VarId, span: Span) {
        self.load(ty, Operand::Place(Target::Variable(variable)), span);
    }

    fn store(&mut self, ty: Type, variable: VarId, span: Span) {
        self.emit(Instruction::Store { ty, negated: false, target: Target::Variable(variable) }, span);
    }

    fn jump(&mut self, condition: Condition, label: Label, span: Span) {
        self.emit(Instruction::Jump { condition, target: label.0 }, span);
    }

    fn label(&mut self) -> Label {
        self.labels.push(usize::MAX);
        Label(self.labels.len() - 1)
    }

    fn place_label(&mut self, label: Label) {
        self.labels[label.0] = self.code.len();
    }

    /// Replaces labels by lines.
    fn resolve(&mut self) {
        for line in &mut self.code {
            if let Instruction::Jump { target, .. } = &mut line.instruction {
                *target = self.labels[*target];
            }
        }
    }
}
