//! Priorities of operators: one table for requirements, LTL formulas and safety functions.
//!
//! The priorities are those of Structured Text in IEC 61131-3; implications, which it does not have, bind most weakly.
//! Each grammar has its own type of rules, so the table is made of macros.

/// The connectives, from the weakest to the strongest.
#[macro_export]
macro_rules! connectives {
    ($rule:ident) => {
        PrattParser::new()
            .op(Op::infix($rule::iff, Assoc::Left))
            .op(Op::infix($rule::implies, Assoc::Right))
            .op(Op::infix($rule::or, Assoc::Left))
            .op(Op::infix($rule::xor, Assoc::Left))
            .op(Op::infix($rule::and, Assoc::Left))
    };
}

/// Comparisons and arithmetic, which bind more strongly.
#[macro_export]
macro_rules! comparisons {
    ($parser:expr, $rule:ident) => {{
        let left = |rule| Op::infix(rule, Assoc::Left);
        $parser
            .op(left($rule::equal) | left($rule::unequal))
            .op(left($rule::less) | left($rule::at_most) | left($rule::greater) | left($rule::at_least))
            .op(left($rule::plus) | left($rule::minus))
            .op(left($rule::times) | left($rule::unfit))
    }};
}

/// Where the second of two comparisons in a row stands, as in `a = b = c`, among the parts of a formula; connectives come between others.
/// IEC 61131-3 would compare the truth of the first with `c`, and who writes it hardly means that.
#[macro_export]
macro_rules! chained {
    ($pairs:expr, $rule:ident: $($comparison:ident)|+; $($connective:ident)|+) => {{
        let mut compared = false;
        let second = $pairs.find(|part| match part.as_rule() {
            $($rule::$comparison)|+ => std::mem::replace(&mut compared, true),
            $($rule::$connective)|+ => {
                compared = false;
                false
            }
            _ => false,
        });
        second.map(|part| span(&part))
    }};
}
