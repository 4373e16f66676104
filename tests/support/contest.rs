//! Instances of the Model Checking Contest, with the answers that others agreed on. `PETRIL_DATA` names the folder that holds
//! the contest's archives in `mcc/`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use petril::exchange::mcc::{self, Property};
use petril::exchange::pnml;
use petril::logic::Nodes;
use petril::net::Located;
use petril::source::Source;

/// The folders of the instances, unpacked; none without data.
pub fn instances(folder: &Path) -> Vec<PathBuf> {
    let archives = env::var_os("PETRIL_DATA").map(|data| Path::new(&data).join("mcc")).filter(|mcc| mcc.exists());
    let Some(archives) = archives else {
        eprintln!("there are no archives of the contest: nothing is tested");
        return Vec::new();
    };
    for archive in fs::read_dir(archives).unwrap().map(|entry| entry.unwrap().path()) {
        let tar = Command::new("tar").arg("xzf").arg(&archive).arg("-C").arg(folder).status();
        assert!(tar.is_ok_and(|status| status.success()), "{} cannot be unpacked", archive.display());
    }
    let mut instances: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(!instances.is_empty());
    instances.sort();
    instances
}

/// A file of an instance.
pub fn source(path: &Path) -> Source {
    Source::new(path.to_str().unwrap(), fs::read_to_string(path).unwrap())
}

/// A net of the contest.
pub struct Instance {
    pub name: String,
    pub located: Located,
    folder: PathBuf,
    places: Vec<String>,
    transitions: Vec<String>,
}

impl Instance {
    /// The one in a folder.
    pub fn of(folder: &Path) -> Self {
        let model = source(&folder.join("model.pnml"));
        Self {
            name: folder.file_name().unwrap().to_str().unwrap().to_owned(),
            located: pnml::read(&model).unwrap(),
            folder: folder.to_owned(),
            places: ids(model.text(), "place"),
            transitions: ids(model.text(), "transition"),
        }
    }

    /// The nodes by their ids.
    pub fn nodes(&self) -> Nodes<'_> {
        let net = &self.located.net;
        let transitions = self.transitions.iter().map(String::as_str).zip(net.transition_ids());
        Nodes::by_id(self.places.iter().map(String::as_str).zip(net.place_ids()), transitions)
    }

    /// What a file asks, in the order of the ids, which is that of the answers.
    pub fn properties(&self, file: &str) -> Vec<Property> {
        let (mut properties, _) = mcc::read(&source(&self.folder.join(format!("{file}.xml"))));
        properties.sort_by(|a, b| a.id.cmp(&b.id));
        properties
    }

    /// What others said; `short` is how they name what was asked.
    pub fn oracle(&self, short: &str) -> String {
        fs::read_to_string(self.folder.join(format!("oracle/{}-{short}.out", self.name))).unwrap()
    }

    /// The answers to formulas.
    pub fn answers(&self, short: &str) -> Vec<String> {
        let oracle = self.oracle(short);
        let answers = oracle.lines().filter_map(|line| line.strip_prefix("FORMULA ")?.split(' ').nth(1));
        answers.map(str::to_owned).collect()
    }
}

/// The ids of the nodes of a kind in a net whose places and transitions stand on one page.
fn ids(net: &str, kind: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(net).unwrap();
    let nodes = document.descendants().filter(|node| node.tag_name().name() == kind);
    nodes.filter_map(|node| node.attribute("id").map(str::to_owned)).collect()
}
