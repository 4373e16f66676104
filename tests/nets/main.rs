//! Place/transition nets: engine, questions, structure, reductions and formats.

mod arithmetic_of_nets;
mod contest;
mod engine_agrees_with_naive;
mod exchange;
mod formats;
mod goals_agree_with_naive;
mod net_ctl_agrees_with_textbook;
mod partial_nets_agree_with_naive;
mod reductions;
mod reductions_keep_what_they_say;
mod reductions_of_contest;
mod structure;
