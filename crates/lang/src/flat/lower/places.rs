//! Lowering of places to variables of flat code, with the instructions that compute an index.

use super::layout::bits_for;
use super::{Frame, Lowering};
use crate::flat::{Element, Function, Hazard, Instruction, Operand, Target};
use crate::semantics::{self, Index, Kind, Place, Root, Shape, Step, Type, VarId};
use petril_base::source::Span;

/// Address of the first elementary variable of a place.
#[derive(Clone, Copy, Debug)]
pub enum Address {
    /// Position among the variables.
    Direct(usize),
    /// Position selected by an index.
    Indexed(Element),
}

impl Address {
    fn shifted(self, by: usize) -> Self {
        match self {
            Self::Direct(first) => Self::Direct(first + by),
            Self::Indexed(element) => Self::Indexed(Element { first: VarId(element.first.0 + by), ..element }),
        }
    }

    /// Target for an elementary variable at the address.
    pub fn target(self) -> Target {
        match self {
            Self::Direct(first) => Target::Variable(VarId(first)),
            Self::Indexed(element) => Target::Element(element),
        }
    }
}

/// Variable index of an element: the variable, the range of the index, and the distance between its values.
struct Chosen {
    index: Target,
    ty: Type,
    range: (i64, i64),
    stride: usize,
}

impl<'p> Lowering<'p> {
    /// Computes the address of a place. If an index has to be computed, the current result is kept, if `result` is its
    /// type; the buffer of the index is to be released with [`Lowering::release_address`].
    pub fn address(&mut self, frame: &Frame<'p>, place: &Place, result: Option<Type>, span: Span) -> Address {
        let (mut address, mut shape) = match place.root {
            Root::Own(position) => {
                let shape = frame.pou.variables[position].shape.clone();
                (frame.variables[position].unwrap_or(Address::Direct(0)), shape)
            }
            Root::Global(position) => (self.globals[position], self.program.globals[position].shape.clone()),
        };
        let mut chosen: Vec<Chosen> = Vec::new();
        for step in &place.steps {
            match (step, shape) {
                (Step::Member(member), inner @ Shape::Structure(_)) => {
                    address = address.shifted(self.layouts.offset(&inner, *member));
                    let Shape::Structure(structure) = &inner else { break };
                    shape = structure.members[*member].shape.clone();
                }
                (Step::Member(member), inner @ Shape::Instance(_)) => {
                    address = address.shifted(self.layouts.offset(&inner, *member));
                    let Shape::Instance(id) = inner else { break };
                    shape = self.pou(id).variables[*member].shape.clone();
                }
                (Step::Index(indices), Shape::Array { ranges, of }) => {
                    let mut stride = self.layouts.size(&of);
                    let mut strides: Vec<usize> = Vec::new();
                    for &(lower, upper) in ranges.iter().rev() {
                        strides.push(stride);
                        stride *= (upper - lower + 1) as usize;
                    }
                    strides.reverse();
                    for ((index, &range), stride) in indices.iter().zip(&ranges).zip(strides) {
                        match index {
                            Index::Constant(number) => address = address.shifted((number - range.0) as usize * stride),
                            Index::Variable(place) => {
                                let index = self.address(frame, place, None, span).target();
                                chosen.push(Chosen { index, ty: place.scalar().ty, range, stride });
                            }
                        }
                    }
                    shape = *of;
                }
                (_, other) => shape = other,
            }
        }
        match (address, chosen.as_slice()) {
            (_, []) => address,
            (Address::Direct(first), _) => self.indexed(first, &chosen, result, span),
            (indexed @ Address::Indexed(_), _) => indexed,
        }
    }

    /// Emits the instructions that combine several indices into one.
    fn indexed(&mut self, first: usize, chosen: &[Chosen], result: Option<Type>, span: Span) -> Address {
        let saved = result.map(|ty| {
            let buffer = self.acquire(ty, ty.width);
            self.store(ty, buffer, span);
            (ty, buffer)
        });
        // The last index is the fastest; its stride divides all others.
        let stride = chosen.last().map_or(1, |last| last.stride);
        let lengths = chosen.iter().map(|one| (one.range.1 - one.range.0) as usize * (one.stride / stride));
        let length = lengths.sum::<usize>() + 1;
        let index = self.acquire(wide(length as i64), bits_for(length as u64 - 1));
        let index_ty = self.variables[index.0].ty;
        for (position, one) in chosen.iter().enumerate() {
            let (lower, upper) = one.range;
            self.load(one.ty, Operand::Place(one.index), span);
            let (least, greatest) = (i128::from(lower), i128::from(upper));
            self.emit(Instruction::Bound { ty: one.ty, lower: least, upper: greatest, hazard: Hazard::Index }, span);
            // The number fits in a type that has both the range and the index.
            let between = wide((upper - lower).max(upper).max(-lower));
            let between = Type::new(Kind::Signed, between.width.max(16));
            self.convert(one.ty, between, span);
            self.combine(Function::Sub, between, i128::from(lower), span);
            self.convert(between, index_ty, span);
            self.combine(Function::Mul, index_ty, (one.stride / stride) as i128, span);
            if position > 0 {
                let operand = Operand::Place(Target::Variable(index));
                self.emit(
                    Instruction::Combine { function: Function::Add, ty: index_ty, negated: false, operand },
                    span,
                );
            }
            self.store(index_ty, index, span);
        }
        if let Some((ty, buffer)) = saved {
            self.load_variable(ty, buffer, span);
            self.release(buffer);
        }
        Address::Indexed(Element { first: VarId(first), stride, length, index })
    }

    fn convert(&mut self, from: Type, to: Type, span: Span) {
        if from != to {
            // The number is known to fit, so its bits are taken as they are.
            let bits = |ty: Type| Type::new(Kind::Bits, ty.width);
            if to.width > from.width && from.is_signed() {
                self.emit(Instruction::Convert { from, to: Type::new(Kind::Signed, to.width) }, span);
            } else if to.width != from.width {
                self.emit(Instruction::Convert { from: bits(from), to: bits(to) }, span);
            }
        }
    }

    fn combine(&mut self, function: Function, ty: Type, number: i128, span: Span) {
        let is_neutral = matches!((function, number), (Function::Sub, 0) | (Function::Mul, 1));
        if !is_neutral {
            // The number is known to fit: as bits it cannot overflow.
            let ty = Type::new(Kind::Bits, ty.width);
            self.emit(
                Instruction::Combine { function, ty, negated: false, operand: Operand::Constant(ty.pattern(number)) },
                span,
            );
        }
    }

    /// Releases the index of an address.
    pub fn release_address(&mut self, operand: Operand) {
        if let Operand::Place(Target::Element(element)) = operand {
            self.release(element.index);
        }
    }

    /// Lowers the operand of an instruction.
    pub fn operand(
        &mut self,
        frame: &Frame<'p>,
        operand: &semantics::Operand,
        result: Option<Type>,
        span: Span,
    ) -> Operand {
        match operand {
            semantics::Operand::Literal(position) => Operand::Constant(frame.pou.literals[*position]),
            semantics::Operand::Place(place) => Operand::Place(self.address(frame, place, result, span).target()),
        }
    }
}

/// Least unsigned type of at least 8 bits that has all numbers up to this, with a bit to spare.
fn wide(greatest: i64) -> Type {
    let width = match greatest {
        ..0x80 => 8,
        0x80..0x8000 => 16,
        0x8000..0x8000_0000 => 32,
        _ => 64,
    };
    Type::new(Kind::Unsigned, width)
}
