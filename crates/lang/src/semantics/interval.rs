//! Scan time, where a task gives it.

use super::constant::milliseconds;
use crate::syntax::ast::{Literal, Name, Task, Unit};
use petril_base::diagnostic::{Code, Diagnostic};

/// Interval of the task that runs a program, in milliseconds.
pub fn of(unit: &Unit, program: &Name, found: &mut Vec<Diagnostic>) -> Option<u64> {
    let configurations = unit.configurations.iter();
    let mut tasks = configurations.flat_map(|configuration| {
        let instances = configuration.programs.iter().filter(|instance| instance.program.key() == program.key());
        instances.filter_map(|instance| {
            let task = instance.task.as_ref()?;
            Some((task, configuration.tasks.iter().find(|candidate| candidate.name.key() == task.key())))
        })
    });
    let (name, task) = tasks.next()?;
    let Some(task) = task else {
        let message = format!("there is no task `{}`", name.text);
        found.push(Diagnostic::new(Code::TaskUnfit, name.span, message));
        return None;
    };
    let first = interval(task, found);
    if first.is_none() && task.interval.is_some() {
        return None;
    }
    // One scan time stands for the program: timers would count another one differently.
    for (other, task) in tasks.filter_map(|(name, task)| Some((name, task?))) {
        let its = interval(task, &mut Vec::new());
        if its != first {
            let text = |interval: Option<u64>| interval.map_or("no interval".to_owned(), |ms| format!("{ms} ms"));
            let message =
                format!("instances of `{}` run in tasks of {} and of {}", program.text, text(first), text(its));
            found.push(
                Diagnostic::new(Code::TaskUnfit, other.span, message)
                    .also(name.span, "the first instance runs in this task")
                    .help("leave the instance that is to be checked, and remove the others"),
            );
            break;
        }
    }
    first
}

fn interval(task: &Task, found: &mut Vec<Diagnostic>) -> Option<u64> {
    let constant = task.interval.as_ref()?;
    let time = match constant.literal {
        Some(Literal::Time(micros)) => milliseconds(micros).ok(),
        _ => None,
    };
    let interval = time.and_then(|time| u64::try_from(time).ok()).filter(|&time| time > 0 && time < 1 << 31);
    if interval.is_none() {
        let message = format!("`{}` is no time from one scan to the next", constant.text);
        found.push(
            Diagnostic::new(Code::TaskUnfit, constant.span, message)
                .help("write whole milliseconds, like `INTERVAL := T#20ms`"),
        );
    }
    interval
}
