//! State of the interactive screen: session, selection, mode.

use petril::flat::FlatProgram;
use petril::logic::View;
use petril::semantics::{Role, VarId};
use petril::simulate::{Breakpoint, Chance, Session, Stopped};
use petril::source::Source;
use petril::verdict::Note;

use crate::cli::input_table;

/// Keys of free inputs. Omitted letters have other meanings.
const LABELS: &str = "123456789abdefghimouvwxyz";

/// Upper bounds on a run to a condition: scans, values stored for them, and firings for conditions on these.
const RUN_SCANS: usize = 10_000;
const RUN_VALUES: usize = 1 << 25;
const RUN_FIRINGS: usize = 100_000;

/// Interactive screen.
pub struct Screen<'s> {
    pub session: Session<'s>,
    pub source: &'s Source,
    chance: Chance<'s>,
    /// Variables in the order of the list: inputs, outputs, memory, constants.
    pub variables: Vec<VarId>,
    /// Free inputs with their keys.
    labels: Vec<(char, VarId)>,
    /// Position of the selected variable in the list.
    pub chosen: usize,
    pub mode: Mode,
    pub shows_tokens: bool,
    /// Message about the last key, and whether it is an error.
    pub message: Option<(String, bool)>,
    /// Last condition typed.
    pub condition: String,
    /// Notes of a recorded run, with their positions.
    notes: Vec<Note>,
}

/// Mode of the screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Stepping through the run.
    Steps,
    /// Reading the help.
    Help,
    /// Choosing plant moves; position of the selected one.
    Plant(usize),
    /// Typing the value of an input.
    Value(VarId, String),
    /// Typing a condition.
    Until(String),
}

impl<'s> Screen<'s> {
    /// Creates the screen of a session; `seed` is for random scans.
    pub fn new(session: Session<'s>, source: &'s Source, notes: Vec<Note>, seed: u64) -> Self {
        let system = session.system();
        let roles = [Role::Input, Role::Output, Role::Memory, Role::Constant];
        let variables = roles.into_iter().flat_map(|role| system.program.with_role(role)).collect();
        Self {
            chance: Chance::new(system, seed),
            variables,
            labels: LABELS.chars().zip(system.free_inputs()).collect(),
            chosen: 0,
            mode: Mode::Steps,
            shows_tokens: false,
            message: None,
            condition: String::new(),
            notes,
            session,
            source,
        }
    }

    pub fn program(&self) -> &'s FlatProgram {
        &self.session.system().program
    }

    /// Notes about the last scan, if the run is still the recorded one.
    pub fn note(&self) -> Option<String> {
        let ended = self.session.is_as_planned() && !self.session.is_within();
        let last = self.session.scans().len().checked_sub(1).filter(|_| ended)?;
        let notes = self.notes.iter().filter(|note| (note.first..=note.last).contains(&last));
        let texts: Vec<String> = notes.map(|note| note.sentence(View::Scan)).collect();
        (!texts.is_empty()).then(|| texts.join("; "))
    }

    /// Key of an input, if it has one.
    pub fn label(&self, input: VarId) -> Option<char> {
        self.labels.iter().find(|&&(_, labelled)| labelled == input).map(|&(label, _)| label)
    }

    /// Input of a key.
    pub fn labelled(&self, key: char) -> Option<VarId> {
        self.labels.iter().find(|&&(label, _)| label == key).map(|&(_, input)| input)
    }

    /// Shows a message.
    pub fn say(&mut self, text: impl Into<String>) {
        self.message = Some((text.into(), false));
    }

    /// Shows an error.
    pub fn complain(&mut self, text: impl Into<String>) {
        self.message = Some((text.into(), true));
    }

    /// Performs an action on the session and shows why it failed.
    pub fn attempt(&mut self, action: impl FnOnce(&mut Session<'s>) -> Result<(), Stopped>) {
        if let Err(stopped) = action(&mut self.session) {
            self.complain(stopped.to_string());
        } else if let Some(failure) = self.session.failure() {
            self.complain(Stopped::Failed(failure).to_string());
        }
    }

    /// Changes an input: negates a Boolean, or asks for a number.
    pub fn change(&mut self, input: VarId) {
        if self.program().variable(input).ty.is_bool() {
            self.attempt(|session| session.toggle(input));
        } else if let Err(stopped) = self.session.may_set(input) {
            self.complain(stopped.to_string());
        } else {
            self.mode = Mode::Value(input, String::new());
        }
    }

    /// Sets an input to a typed value; asks again if it is invalid.
    pub fn take_value(&mut self, input: VarId, text: &str) {
        match input_table::value(self.program(), input, text.trim()) {
            Some(value) => self.attempt(|session| session.set(input, value)),
            None => {
                let name = &self.program().variable(input).name;
                self.complain(format!(
                    "`{text}` is no value of `{name}`: {}",
                    input_table::values(self.program(), input)
                ));
                self.mode = Mode::Value(input, text.to_owned());
            }
        }
    }

    /// Executes a random scan.
    pub fn random_scan(&mut self) {
        if self.session.is_within() {
            self.complain(Stopped::UnderWay.to_string());
            return;
        }
        let chance = &mut self.chance;
        let session = &mut self.session;
        let stepped = session.draw_lots(chance).and_then(|()| session.step_scan());
        self.attempt(|_| stepped);
    }

    /// Runs until the condition is met, with inputs unchanged, or random where nothing is planned. If it is not met,
    /// the session is restored.
    pub fn run(&mut self, by_chance: bool) {
        if self.condition.trim().is_empty() {
            self.complain("there is no condition yet: type one with /");
            return;
        }
        let text = Source::new("condition", self.condition.as_str());
        let breakpoint = match Breakpoint::read(&text, self.session.system()) {
            Ok(breakpoint) => breakpoint,
            Err(errors) => {
                let words = errors.first().map(|error| {
                    [error.message.clone()]
                        .into_iter()
                        .chain(error.help.first().cloned())
                        .collect::<Vec<_>>()
                        .join("; ")
                });
                self.complain(words.unwrap_or_default());
                self.mode = Mode::Until(self.condition.clone());
                return;
            }
        };
        let (limit, unit) = match breakpoint {
            Breakpoint::Scans(_) => (RUN_SCANS.min(1 + RUN_VALUES / self.program().variables.len().max(1)), "scans"),
            Breakpoint::Firings(_) => (RUN_FIRINGS, "firings"),
        };
        let begun = self.session.clone();
        let chance = by_chance.then_some(&mut self.chance);
        match self.session.run_until(&breakpoint, limit, chance) {
            Ok(true) => self.say(format!("`{}` is true", self.condition)),
            Ok(false) => {
                self.session = begun;
                self.complain(format!("`{}` would be true after none of {limit} {unit}", self.condition));
            }
            Err(stopped) => self.complain(stopped.to_string()),
        }
    }
}
