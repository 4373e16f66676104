//! The standard function blocks as random programs call them.

use petril::semantics::Type;

use super::random_wide_program::{BOOL, Of, PLAIN_INT, Unit};

/// The standard function blocks, those without timers more often.
pub fn standard() -> Vec<Unit> {
    let unit = |name: &str, inputs: &[(&str, Of)], outputs: &[(&str, Of)]| {
        let list = |list: &[(&str, Of)]| list.iter().map(|&(name, of)| (name.to_owned(), of)).collect();
        Unit { name: name.to_owned(), result: None, inputs: list(inputs), outputs: list(outputs), in_out: None }
    };
    let (time, int) = (Of::Plain(Type::TIME), PLAIN_INT);
    let timer = |name| unit(name, &[("IN", BOOL), ("PT", time)], &[("Q", BOOL), ("ET", time)]);
    let edge = |name| unit(name, &[("CLK", BOOL)], &[("Q", BOOL)]);
    let counter = |name, inputs: &[(&str, Of)]| unit(name, inputs, &[("Q", BOOL), ("CV", int)]);
    vec![
        unit("SR", &[("S1", BOOL), ("R", BOOL)], &[("Q1", BOOL)]),
        unit("RS", &[("S", BOOL), ("R1", BOOL)], &[("Q1", BOOL)]),
        edge("R_TRIG"),
        edge("F_TRIG"),
        counter("CTU", &[("CU", BOOL), ("R", BOOL), ("PV", int)]),
        counter("CTD", &[("CD", BOOL), ("LD", BOOL), ("PV", int)]),
        unit(
            "CTUD",
            &[("CU", BOOL), ("CD", BOOL), ("R", BOOL), ("LD", BOOL), ("PV", int)],
            &[("QU", BOOL), ("QD", BOOL), ("CV", int)],
        ),
        timer("TON"),
        timer("TOF"),
        timer("TP"),
    ]
}
