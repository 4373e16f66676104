//! Variables, and numbers.

use super::{Cell, Frame, Hazard, Index, Kind, Location, Operand, Place, Reference, Root, Scalar, Shape, Step, Type};
use super::{Function, complement, one};

impl<'p> Reference<'p> {
    /// Where a place is now; an index outside its range becomes the least.
    pub(super) fn location(&mut self, frame: &Frame<'p>, place: &'p Place) -> Location {
        let (mut location, mut shape) = match place.root {
            Root::Own(position) => {
                let location = frame.variables[position].clone().expect("a place is somewhere");
                (location, frame.pou.variables[position].shape.clone())
            }
            Root::Global(position) => {
                let location = Location { variable: self.globals + position, way: Vec::new() };
                (location, self.program.globals[position].shape.clone())
            }
        };
        for step in &place.steps {
            let next = match (step, &shape) {
                (Step::Member(member), Shape::Structure(structure)) => {
                    location.way.push(*member);
                    structure.members[*member].shape.clone()
                }
                (Step::Member(member), Shape::Instance(id)) => {
                    location.way.push(*member);
                    self.program.pous[id].variables[*member].shape.clone()
                }
                (Step::Index(indices), Shape::Array { ranges, of }) => {
                    let mut position = 0;
                    for (index, &(lower, upper)) in indices.iter().zip(ranges) {
                        let number = match index {
                            Index::Constant(number) => i128::from(*number),
                            Index::Variable(place) => {
                                let at = self.location(frame, place);
                                place.scalar().ty.number(one(self.cell_at(&at)))
                            }
                        };
                        let is_inside = (i128::from(lower)..=i128::from(upper)).contains(&number);
                        self.note((!is_inside).then_some(Hazard::Index));
                        let number = if is_inside { number - i128::from(lower) } else { 0 };
                        position = position * (upper - lower + 1) as usize + number as usize;
                    }
                    location.way.push(position);
                    (**of).clone()
                }
                _ => panic!("{step:?} leads nowhere in {shape:?}"),
            };
            shape = next;
        }
        location
    }

    pub(super) fn cell_at(&mut self, location: &Location) -> &mut Cell {
        location.way.iter().fold(&mut self.memory[location.variable], |cell, &step| match cell {
            Cell::Parts(cells) => &mut cells[step],
            Cell::One(_) => panic!("one value has no parts"),
        })
    }

    pub(super) fn operand(&mut self, frame: &Frame<'p>, operand: &'p Operand) -> u64 {
        match operand {
            Operand::Literal(position) => frame.pou.literals[*position],
            Operand::Place(place) => {
                let location = self.location(frame, place);
                one(self.cell_at(&location))
            }
        }
    }

    /// The value of a variable of a unit.
    pub(super) fn variable(&mut self, frame: &Frame<'p>, position: usize) -> u64 {
        let location = frame.variables[position].clone().expect("it has a place");
        one(self.cell_at(&location))
    }

    pub(super) fn store(&mut self, frame: &Frame<'p>, ty: Type, negated: bool, place: &'p Place) {
        let value = complement(ty, negated, self.result);
        self.bound(&place.scalar(), value);
        let location = self.location(frame, place);
        *self.cell_at(&location) = Cell::One(value);
    }

    /// A value that a variable gets is looked at, if the variable has a subrange.
    pub(super) fn bound(&mut self, scalar: &Scalar, value: u64) {
        if let (Some((lower, upper)), None) = (scalar.range, &scalar.enumeration) {
            let is_inside = (lower..=upper).contains(&scalar.ty.number(value));
            self.note((!is_inside).then_some(Hazard::Subrange));
        }
    }

    pub(super) fn note(&mut self, hazard: Option<Hazard>) {
        self.hazards.extend(hazard);
    }

    /// A number as a value of a type.
    pub(super) fn fit(&mut self, ty: Type, number: i128) -> u64 {
        self.note((!ty.holds(number)).then_some(Hazard::Overflow));
        ty.pattern(number)
    }

    pub(super) fn convert(&mut self, from: Type, to: Type, value: u64) -> u64 {
        let number = from.number(value);
        if to.is_bool() {
            return u64::from(number != 0);
        }
        if from.kind == Kind::Bits || to.kind == Kind::Bits {
            return to.pattern(number);
        }
        self.fit(to, number)
    }

    pub(super) fn compute(&mut self, function: Function, ty: Type, left: u64, right: u64) -> u64 {
        let (left, right) = (left & ty.mask(), if function.shifts() { right } else { right & ty.mask() });
        let (a, b) = (ty.number(left), ty.number(right));
        let width = u64::from(ty.width);
        let rotated = |by: u64| (0..width).fold(0, |all, bit| all | (left >> bit & 1) << ((bit + by) % width));
        match function {
            Function::And => left & right,
            Function::Or => left | right,
            Function::Xor => left ^ right,
            Function::Add => self.fit(ty, a + b),
            Function::Sub => self.fit(ty, a - b),
            Function::Mul => self.fit(ty, a * b),
            Function::Div | Function::Mod if b == 0 => {
                self.note(Some(Hazard::DivisionByZero));
                0
            }
            Function::Div => self.fit(ty, a / b),
            Function::Mod => ty.pattern(a % b),
            Function::Gt => u64::from(a > b),
            Function::Ge => u64::from(a >= b),
            Function::Eq => u64::from(a == b),
            Function::Ne => u64::from(a != b),
            Function::Le => u64::from(a <= b),
            Function::Lt => u64::from(a < b),
            Function::Shl => ty.pattern(if right >= width { 0 } else { i128::from(left) << right }),
            Function::Shr => {
                if right >= width {
                    0
                } else {
                    left >> right
                }
            }
            Function::Rol => rotated(right % width),
            Function::Ror => rotated(width - right % width),
        }
    }
}
