//! Small programs and functions to be proved, and what a proof says of them.

use petril::flat::FlatProgram;
use petril::sif::proof::{By, Confirmed, Outcome, Proof};

/// A program with Boolean inputs and outputs.
pub fn program(inputs: &str, outputs: &str, more: &str, body: &str) -> FlatProgram {
    super::program(&format!(
        "PROGRAM p VAR_INPUT {inputs} : BOOL; END_VAR VAR_OUTPUT {outputs} : BOOL; END_VAR {more}\n{body}\nEND_PROGRAM"
    ))
}

/// A function of inputs a, b, c with one output y.
pub fn function(output: &str, formal: &str) -> String {
    format!("function F {{ interface {{ input a; input b; input c; output y{output}; }} formal {{ {formal} }} }}")
}

/// The one outcome, and its scans as the values of a, b, c in each.
pub fn refuted(proof: &Proof) -> Vec<String> {
    let [answer] = proof.answers.as_slice() else { panic!("{proof:#?}") };
    let Outcome::Refuted(scans) = &answer.outcome else { panic!("{:#?}", answer.outcome) };
    let inputs =
        |scan: &petril::sif::proof::Scan| scan.given.inputs.iter().map(|(_, value)| value.to_string()).collect();
    scans.iter().map(inputs).collect()
}

/// How the one outcome was proved, and by what it was confirmed.
pub fn proved(proof: &Proof) -> (By, Option<Confirmed>) {
    let [answer] = proof.answers.as_slice() else { panic!("{proof:#?}") };
    let Outcome::Proved { by, confirmed } = answer.outcome else { panic!("{:#?}", answer.outcome) };
    assert!(proof.failures.is_empty() && proof.unknown_failures.is_empty(), "{proof:#?}");
    (by, confirmed)
}
