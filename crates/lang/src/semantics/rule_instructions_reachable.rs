//! Every instruction is reachable.
//!
//! Passes: `JMPC on`, `LD a`, `on: LD b`.
//! Fails: `JMP on`, `LD a`, `on: LD b`: nothing ever executes `LD a`.

use super::{Context, control_flow};
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let body = &context.pou.body;
    if !control_flow::is_known(body) {
        return Vec::new();
    }
    let reachable = &context.flow().reachable;
    let mut found = Vec::new();
    let mut i = 0;
    while i < body.len() {
        let run = reachable[i..body.len()].iter().take_while(|&&reachable| !reachable).count();
        if run > 0 {
            let message = match body[i..i + run].iter().filter(|instruction| instruction.operation.is_some()).count() {
                0 | 1 => "this instruction can never be executed".to_owned(),
                n => format!("these {n} instructions can never be executed"),
            };
            found.push(Diagnostic::new(Code::InstructionUnreachable, body[i].span.to(body[i + run - 1].span), message));
        }
        i += run + 1;
    }
    found
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn each_stretch_of_dead_code_is_reported_once() {
        let text = program("LD i\nJMP on\nLD j\nST m\non: ST q\nRET\nLD j");
        assert_eq!(lines(Code::InstructionUnreachable, &text), [4, 8]);
    }
}
