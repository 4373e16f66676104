//! Reports in every form, and pictures.

mod committed_pictures;
mod folded_runs;
mod hostile_texts;
mod html_report;
mod pictures;
mod printed_early;
mod report_forms;
