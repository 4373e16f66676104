//! A jump goes forward. A jump back makes a loop, and a loop may keep a scan from ending.
//!
//! Passes: `JMPC on`, `LD a`, `on: LD b`.
//! Fails: `back: LD a`, `JMPC back`. (Only a warning: whether every scan ends is proved with everything else.)

use super::Context;
use crate::syntax::ast::Operation;
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let jumps = context.pou.body.iter().enumerate().filter_map(|(i, instruction)| match &instruction.operation {
        Some(Operation::Jump { target, .. }) => {
            super::target(&context.labels, target).filter(|&at| at <= i).map(|at| (instruction, at))
        }
        _ => None,
    });
    jumps
        .map(|(instruction, at)| {
            Diagnostic::new(
                Code::JumpBack,
                instruction.span,
                "this jump goes back, so the scan may take long or never end",
            )
            .also(context.pou.body[at].span, "to here")
            .help("whether every scan ends is one of the checks made; the watchdog of the controller is not modelled")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn jumps_back_are_told_from_jumps_on() {
        assert_eq!(
            lines(Code::JumpBack, &program("LD i\nback: ST q\nJMPC on\nLD j\nJMPC back\non: LD m\nself: JMPC self")),
            [6, 8]
        );
    }
}
