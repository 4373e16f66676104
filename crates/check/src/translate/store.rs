//! `ST x`, `STN x`: the variable takes the value of the current result, complemented for `STN`.

use smallvec::smallvec;

use super::element::targets;
use super::subnet::{Step, Subnet};
use super::weaver::VALUES;
use super::wire::with;
use petril_lang::flat::Target;
use petril_lang::semantics::Type;

pub fn translate(subnet: &mut Subnet<'_>, ty: Type, negated: bool, target: Target) {
    let mut steps: Vec<Step> = Vec::new();
    for (alternatives, result) in targets(subnet, target).into_iter().zip(subnet.result(ty.width)) {
        let mut step = Step::new();
        for value in VALUES {
            for (bit, given) in &alternatives {
                let Some(bit) = *bit else {
                    step.push(with((result, value, value), given));
                    continue;
                };
                for old in VALUES {
                    let mut changes = smallvec![(result, value, value), (bit, old, value ^ negated)];
                    changes.extend_from_slice(given);
                    step.push(changes);
                }
            }
        }
        steps.push(step);
    }
    subnet.chain(subnet.here(), subnet.next(), &steps);
}
