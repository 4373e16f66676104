//! Siemens Statement List (STL, in German AWL): a language that looks like Instruction List but has other words;
//! reported once.

use std::collections::BTreeSet;

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Words that begin a line of Statement List and take an operand, in the German and international mnemonics.
const WITH_OPERAND: [&str; 34] = [
    "U", "UN", "O", "ON", "X", "XN", "A", "AN", "L", "T", "=", "FP", "FN", "SPA", "SPB", "SPBN", "SPBB", "SPBNB",
    "SPBI", "SPZ", "SPN", "SPP", "SPM", "JU", "JC", "JCN", "JCB", "JNB", "UC", "CC", "AUF", "OPN", "ZV", "ZR",
];
/// Words that stand alone on a line of Statement List.
const ALONE: [&str; 18] = [
    "U(", "UN(", "O(", "ON(", "A(", "AN(", "X(", "XN(", "SET", "CLR", "SAVE", "BE", "BEA", "BEB", "BEU", "BEC", "==I",
    "<>I",
];
/// Words with which only Statement List begins or ends a block.
const BLOCKS: [&str; 4] = ["ORGANIZATION_BLOCK", "END_ORGANIZATION_BLOCK", "DATA_BLOCK", "END_DATA_BLOCK"];
/// Words that begin no statement of Statement List, and that every program in Instruction List has.
const STANDARD: [&str; 4] = ["LD", "LDN", "ST", "STN"];

/// Evidence of a line for or against Statement List.
enum Sign {
    /// Line that only Statement List has.
    Certain,
    /// Instruction of Statement List, which could also be the name of a function.
    Likely,
    /// Instruction of Instruction List that Statement List does not have.
    Against,
    None,
}

/// Diagnostic for a text, without comments, that is Statement List.
pub fn statement_list(text: &str) -> Option<Diagnostic> {
    let mut likely: Vec<Span> = Vec::new();
    let (mut is_standard, mut start) = (false, 0);
    for line in text.split('\n') {
        let (sign, word) = sign(line);
        let at = start + word.as_ptr() as usize - line.as_ptr() as usize;
        start += line.len() + 1;
        match sign {
            Sign::Certain => return Some(told(Span::new(at, at + word.len()))),
            Sign::Likely => likely.push(Span::new(at, at + word.len())),
            Sign::Against => is_standard = true,
            Sign::None => {}
        }
    }
    let words: BTreeSet<String> =
        likely.iter().map(|&Span { start, end }| text[start..end].to_ascii_uppercase()).collect();
    let is_named = words.iter().any(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()));
    // A single word that occurs again and again may be a mistake of another kind.
    likely.first().filter(|_| is_named && words.len() > 1 && !is_standard).map(|&first| told(first))
}

/// Evidence of a line, and its first word.
fn sign(line: &str) -> (Sign, &str) {
    let statement = match line.split_once(':') {
        Some((label, rest)) if !rest.starts_with('=') && !label.trim().contains(char::is_whitespace) => rest,
        _ => line,
    };
    let statement = statement.trim_start();
    let word = statement.split([' ', '\t', ';', '\r']).next().unwrap_or_default();
    let rest = statement[word.len()..].trim().trim_end_matches(';').trim_end();
    let upper = word.to_ascii_uppercase();
    let is_one_of = |words: &[&str]| words.contains(&upper.as_str());
    let is_operand = !rest.is_empty() && !rest.contains([':', ',', '(']) && rest.split_whitespace().count() <= 2;
    let sign = if is_one_of(&BLOCKS)
        || upper == "NETWORK" && rest.bytes().all(|b| b.is_ascii_digit())
        || upper == "TITLE" && rest.starts_with('=')
        || upper.starts_with("TITLE=")
    {
        Sign::Certain
    } else if is_one_of(&STANDARD) {
        Sign::Against
    } else if is_one_of(&WITH_OPERAND) && is_operand || is_one_of(&ALONE) && rest.is_empty() {
        Sign::Likely
    } else {
        Sign::None
    };
    (sign, word)
}

fn told(place: Span) -> Diagnostic {
    let message = "this is Siemens Statement List (STL, AWL), not Instruction List of IEC 61131-3";
    Diagnostic::new(Code::StatementList, place, message)
        .help("write `LD`, `AND`, `ANDN`, `OR`, `ST` for `U`/`A`, `UN`/`AN`, `O`, `=`, and `%I0.0`, `%Q4.0` for `E0.0`, `A4.0`")
        .help("`petril explain E0114` has a table; blocks exported as PLCopen XML with bodies in IL are read, too")
}

/// Operator of Instruction List that corresponds to an instruction of Statement List.
#[must_use]
pub fn standard_operator(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_uppercase().as_str() {
        "U" | "A" => "AND",
        "UN" | "AN" => "ANDN",
        "O" => "OR",
        "ON" => "ORN",
        "X" => "XOR",
        "XN" => "XORN",
        "L" => "LD",
        "T" => "ST",
        "SPA" | "JU" => "JMP",
        "SPB" | "JC" => "JMPC",
        "SPBN" | "JCN" => "JMPCN",
        "BEA" | "BEU" => "RET",
        "BEB" | "BEC" => "RETC",
        _ => return None,
    })
}

/// Standard spelling of an address in Siemens's German or without `%`: `%E0.0` and `E0.0` are `%I0.0`.
#[must_use]
pub fn standard_address(text: &str) -> Option<String> {
    let upper = text.to_ascii_uppercase();
    let plain = upper.strip_prefix('%').unwrap_or(&upper);
    let area = match plain.chars().next()? {
        'E' | 'I' => 'I',
        'A' | 'Q' => 'Q',
        'M' => 'M',
        _ => return None,
    };
    let rest = &plain[1..];
    let numbers = rest.strip_prefix(['X', 'B', 'W', 'D']).unwrap_or(rest);
    let are_numbers = numbers.split('.').all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()));
    (are_numbers && (numbers.contains('.') || rest != numbers || upper.starts_with('%')))
        .then(|| format!("%{area}{rest}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statement_list_is_recognised() {
        for text in [
            "ORGANIZATION_BLOCK OB 1\nBEGIN\nEND_ORGANIZATION_BLOCK",
            "FUNCTION FC 1 : VOID\nBEGIN\nNETWORK\nEND_FUNCTION",
            "U E0.0\nUN E 0.1;\n= A4.0\n",
            "      A     I      0.0;\n      AN    \"Stop\";\n      =     Q      4.0;\n",
            "PROGRAM p\nm001: L MW 10\nT MW 12\nBEA\nEND_PROGRAM",
            "A(\nO I0.0\nO I0.1\n)\n= Q4.0",
        ] {
            assert!(statement_list(text).is_some(), "{text}");
        }
    }

    #[test]
    fn instruction_list_and_structured_text_are_not() {
        for text in [
            "",
            "PROGRAM p\nVAR A, O : BOOL; T : TON; U: INT; END_VAR\nLD A\nO A\nO A\nST O\nEND_PROGRAM",
            "PROGRAM p\nA := B;\nT := C;\nU := 3;\nEND_PROGRAM",
            "PROGRAM p\nx y;\nx y;\nx z;\nEND_PROGRAM",
            "PROGRAM p\nx := a\n = b;\ny := c\n = d;\nEND_PROGRAM",
            "FUNCTION network : BOOL\nVAR_INPUT\nTitle : BOOL;\nEND_VAR\nEND_FUNCTION",
        ] {
            assert!(statement_list(text).is_none(), "{text}");
        }
    }

    #[test]
    fn its_words_have_a_translation() {
        assert_eq!(
            ["AN", "un", "SPB", "L", "AND"].map(standard_operator),
            [Some("ANDN"), Some("ANDN"), Some("JMPC"), Some("LD"), None]
        );
    }

    #[test]
    fn addresses_of_siemens_have_a_spelling_in_the_standard() {
        let cases = [
            ("E0.0", Some("%I0.0")),
            ("%a4.1", Some("%Q4.1")),
            ("I0.0", Some("%I0.0")),
            ("EW4", Some("%IW4")),
            ("%M3", Some("%M3")),
            ("E0", None),
            ("Auto", None),
            ("A", None),
            ("E0.x", None),
            ("", None),
        ];
        for (text, address) in cases {
            assert_eq!(standard_address(text).as_deref(), address, "{text}");
        }
    }
}
