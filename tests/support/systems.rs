//! Systems for tests, from texts that must be right.

use petril::exchange::tina;
use petril::source::Source;
use petril::translate::{Plant, System};

use super::program;

/// The two-hand switch of the seed paper.
pub const TWO_HAND_SWITCH: &str = include_str!("../../examples/two-hand-switch.il");
/// Its two switches.
pub const HANDS: &str = include_str!("../../nets/two-hand-switch.net");

/// A program among plants in TINA's format.
pub fn system(text: &str, plants: &[&str]) -> System {
    let program = program(text);
    let mut plant = Plant::default();
    for net in plants {
        let net = tina::read(&Source::new("plant.net", *net)).unwrap_or_else(|e| panic!("{net}\n{e:#?}"));
        plant.add(&net, &program).unwrap_or_else(|e| panic!("{e:#?}"));
    }
    System::new(program, plant)
}

/// One program with every kind of instruction; jumps go forwards, back, and to their own line.
pub const EVERY_INSTRUCTION: &str = "PROGRAM every
VAR_INPUT a, x : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR memory : BOOL := TRUE; END_VAR
on:   LD x
      LDN x
      ST q
      STN q
      S memory
      R q
      AND x
      ANDN memory
      OR x
      XOR x
      NOT
      JMPC over
      LD TRUE
      AND FALSE
      OR( a
      XOR q
      )
over: JMPC on
      JMPCN self
      LD a
self: JMP self
      JMP on
END_PROGRAM";

/// A plant that reads an output: a cylinder with two end switches.
pub const CYLINDER: &str = "net cylinder
pl {a=1,x=0} (1)
pl {a=0,x=0}
pl {a=0,x=1}
tr start {a=1,x=0} {q=1}?1 -> {a=0,x=0}
tr arrive {a=0,x=0} {q=1}?1 -> {a=0,x=1}
tr return {a=0,x=1} {q=0}?1 -> {a=1,x=0}
";
