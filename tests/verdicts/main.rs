//! Verdicts and the runs that show them.

mod answers;
mod examples;
mod known;
mod recorded;
mod refused;
mod sessions;
mod stories;
mod tampered_traces;
mod two_hand_switch;
mod waveforms;
