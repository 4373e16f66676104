//! Configurations: tasks with their intervals, and the programs they run.

use roxmltree::Node;

use super::Reader;
use crate::syntax::ast::{Configuration, Constant, Literal, Name, ProgramInstance, Task};
use petril_base::xml::{Text, attribute, tag};

impl Reader<'_> {
    /// Reads an element `<configuration>` with its resources; its global variables become those of the file.
    pub fn configuration(&mut self, node: Node<'_, '_>) -> Option<Configuration> {
        let name = self.required(node, "name")?;
        let mut configuration = Configuration { name, tasks: Vec::new(), programs: Vec::new() };
        for part in node.descendants().filter(Node::is_element) {
            match tag(part) {
                "task" => configuration.tasks.extend(self.task(part)),
                "pouInstance" => configuration.programs.extend(self.instance(part)),
                _ => {}
            }
        }
        Some(configuration)
    }

    fn task(&mut self, node: Node<'_, '_>) -> Option<Task> {
        let name = self.required(node, "name")?;
        Some(Task { name, interval: attribute(node, "interval").and_then(interval) })
    }

    /// Reads an element `<pouInstance>`, run by the task it stands in.
    fn instance(&mut self, node: Node<'_, '_>) -> Option<ProgramInstance> {
        let name = self.required(node, "name")?;
        // Version 1.0 calls the attribute `type`.
        let program = attribute(node, "typeName").or_else(|| attribute(node, "type"))?;
        let task = node.parent_element().filter(|&parent| tag(parent) == "task");
        let task = task.and_then(|task| attribute(task, "name"));
        let named = |Text { text, span }| Name { text, span };
        Some(ProgramInstance { name, task: task.map(named), program: named(program) })
    }
}

/// Interval of a task, which every tool writes in its own way: `T#20ms`, `20ms`, `PT0.02S` (ISO 8601), `00:00:00.02`.
/// `None` for a name, which may stand there as well and does not give a time.
fn interval(Text { text, span }: Text) -> Option<Constant> {
    let upper = text.to_ascii_uppercase();
    let clock: Vec<&str> = upper.split(':').collect();
    let duration = match (upper.strip_prefix("PT"), clock.as_slice()) {
        (Some(parts), _) => format!("T#{parts}"),
        (None, [hours, minutes, seconds]) => format!("T#{hours}h{minutes}m{seconds}s"),
        _ if upper.starts_with(|c: char| c.is_ascii_digit()) && !upper.contains('#') => format!("T#{upper}"),
        _ => upper,
    };
    let is_name = !duration.contains('#');
    let literal = Literal::read(&duration);
    (!is_name).then(|| Constant { text: if literal.is_some() { duration } else { text }, literal, span })
}
