//! Conversion of the current result to another type: truncated or extended, with a check that the new type has the
//! number.

use smallvec::smallvec;

use super::bound;
use super::subnet::{Step, Subnet};
use super::walk::Stage;
use super::weaver::{Bit, VALUES};
use super::wire::Wire;
use petril_lang::flat::Hazard;
use petril_lang::semantics::Type;

pub fn translate(subnet: &mut Subnet<'_>, from: Type, to: Type) {
    let (here, next) = (subnet.here(), subnet.next());
    let bits = subnet.result(from.width.max(to.width));
    let (own, new) = bits.split_at(from.width as usize);
    if to.is_bool() {
        return to_bool(subnet, own);
    }
    let checked = if to.overflows_from(from) && !new.is_empty() { subnet.within() } else { here };
    // Sign extension: a negative number is extended by ones. The original bits stay and can be checked afterwards.
    let extension = if from.is_signed() { Wire::of(own[own.len() - 1]) } else { Wire::fixed(false) };
    let steps: Vec<Step> = new.iter().map(|&bit| extension.assign(bit)).collect();
    if to.overflows_from(from) {
        if !new.is_empty() {
            subnet.chain(here, checked, &steps);
        }
        bound::within(subnet, checked, from, (to.least(), to.greatest()), Hazard::Overflow, next);
        subnet.after_hazard(Hazard::Overflow, next);
    } else {
        subnet.chain(here, next, &steps);
    }
}

/// Translates a conversion to `BOOL`: whether any bit is 1.
fn to_bool(subnet: &mut Subnet<'_>, bits: &[Bit]) {
    #[derive(Clone, PartialEq, Eq, Hash)]
    enum State {
        /// Bits above this one are all 0.
        Zero(usize),
        NotZero,
        Done,
    }
    let (here, next) = (subnet.here(), subnet.next());
    subnet.walk(here, State::Zero(bits.len() - 1), |_, state| match *state {
        // If only the lowest bit is left, it is the truth value.
        State::Zero(0) | State::Done => Stage::Leave(next),
        State::Zero(bit) => {
            let state = |value| if value { State::NotZero } else { State::Zero(bit - 1) };
            Stage::Branch(Wire::of(bits[bit]).branch(state))
        }
        State::NotZero => Stage::Branch(VALUES.map(|old| (smallvec![(bits[0], old, true)], State::Done)).into()),
    });
}
