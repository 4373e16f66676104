//! Formulas: how they are read, and their truth on graphs against textbooks.

mod assertions;
mod ctl_agrees_with_textbook;
mod fairness;
mod formulas;
mod ltl_agrees_with_textbook;
mod parts_agree;
mod past_agrees_with_definitions;
mod patterns;
mod premises;
mod spellings;
