//! Memory available to this process, and memory in use.
//!
//! The default of `--max-memory` is half of the available memory. On Linux, that is the minimum of the machine's
//! memory, the limits of the control groups of the process (version 2 or 1, all levels), and its address space.

use std::fs;
use std::path::Path;

/// Assumed memory in bytes of a machine that does not report it.
const UNKNOWN: u64 = 8 << 30;

/// Default of `--max-memory`, in MiB.
pub fn default_limit() -> u64 {
    ((usable(Path::new("/")).unwrap_or(UNKNOWN) / 2) >> 20).max(1)
}

/// Resident memory of this process in bytes, if known.
pub fn resident() -> Option<u64> {
    number_after(Path::new("/proc/self/status"), "VmRSS:").and_then(|kib| kib.checked_mul(1 << 10))
}

/// Size of this process's address space and its limit in bytes, if there is one.
pub fn address_space() -> Option<(u64, u64)> {
    let space = number_after(Path::new("/proc/self/limits"), "Max address space")?;
    let taken = number_after(Path::new("/proc/self/status"), "VmSize:").and_then(|kib| kib.checked_mul(1 << 10))?;
    Some((taken, space))
}

/// Memory available to this process in bytes; `root` is the root of the file system.
fn usable(root: &Path) -> Option<u64> {
    let machine = number_after(&root.join("proc/meminfo"), "MemTotal:").and_then(|kib| kib.checked_mul(1 << 10));
    let space = number_after(&root.join("proc/self/limits"), "Max address space");
    machine.into_iter().chain(space).chain(control_groups(root)).min()
}

/// The number after a label at the beginning of a line.
fn number_after(file: &Path, label: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    text.lines().find_map(|line| line.strip_prefix(label))?.split_whitespace().next()?.parse().ok()
}

/// Limits of the control groups of this process, from its own to the outermost visible one.
fn control_groups(root: &Path) -> Vec<u64> {
    let groups = fs::read_to_string(root.join("proc/self/cgroup")).unwrap_or_default();
    let mut limits = Vec::new();
    for group in groups.lines() {
        // The format is hierarchy:controllers:path; the hierarchy of version 2 names no controllers.
        let mut fields = group.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else { continue };
        let (mount, files): (_, &[&str]) = match controllers {
            "" => ("sys/fs/cgroup", &["memory.max", "memory.high"]),
            names if names.split(',').any(|name| name == "memory") => {
                ("sys/fs/cgroup/memory", &["memory.limit_in_bytes"])
            }
            _ => continue,
        };
        // In a container, the path may be one outside; then its own group is mounted at the top.
        for level in Path::new(path.trim_start_matches('/')).ancestors() {
            let text = |file| fs::read_to_string(root.join(mount).join(level).join(file)).ok();
            limits.extend(files.iter().filter_map(text).filter_map(|text| text.trim().parse::<u64>().ok()));
        }
    }
    limits
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usable_with(files: &[(&str, &str)]) -> Option<u64> {
        let root = tempfile::tempdir().unwrap();
        for (file, text) in files {
            let file = root.path().join(file);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, text).unwrap();
        }
        usable(root.path())
    }

    const MEMINFO: (&str, &str) = ("proc/meminfo", "MemTotal:       16384000 kB\nMemFree:  5 kB\n");

    #[test]
    fn the_least_limit_counts() {
        assert_eq!(usable_with(&[]), None);
        assert_eq!(usable_with(&[("proc/meminfo", "nonsense")]), None);
        assert_eq!(usable_with(&[MEMINFO]), Some(16_384_000 << 10));
        let limits = "Limit                     Soft Limit           Hard Limit           Units\n\
                      Max address space         4294967296           unlimited            bytes\n";
        assert_eq!(usable_with(&[MEMINFO, ("proc/self/limits", limits)]), Some(4 << 30));
        let limits = limits.replace("4294967296", "unlimited ");
        assert_eq!(usable_with(&[MEMINFO, ("proc/self/limits", &limits)]), Some(16_384_000 << 10));
    }

    #[test]
    fn control_groups_of_both_versions_count_on_all_levels() {
        let second = ("proc/self/cgroup", "0::/user.slice/job.scope\n");
        let inner = ("sys/fs/cgroup/user.slice/job.scope/memory.max", "2147483648\n");
        let outer = ("sys/fs/cgroup/user.slice/memory.max", "1073741824\n");
        let unlimited = ("sys/fs/cgroup/user.slice/memory.max", "max\n");
        assert_eq!(usable_with(&[MEMINFO, second, inner]), Some(2 << 30));
        assert_eq!(usable_with(&[MEMINFO, second, inner, outer]), Some(1 << 30));
        assert_eq!(usable_with(&[MEMINFO, second, inner, unlimited]), Some(2 << 30));
        let throttled = ("sys/fs/cgroup/user.slice/job.scope/memory.high", "536870912\n");
        assert_eq!(usable_with(&[MEMINFO, second, inner, throttled]), Some(512 << 20));
        // A container sees its own group at the top.
        assert_eq!(usable_with(&[MEMINFO, second, ("sys/fs/cgroup/memory.max", "3221225472\n")]), Some(3 << 30));
        let first = ("proc/self/cgroup", "7:cpu,cpuacct:/elsewhere\n4:memory:/docker/a\n1:name=systemd:/x\n");
        let limit = ("sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes", "1073741824\n");
        assert_eq!(usable_with(&[MEMINFO, first, limit]), Some(1 << 30));
        let unlimited = ("sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes", "9223372036854771712\n");
        assert_eq!(usable_with(&[MEMINFO, first, unlimited]), Some(16_384_000 << 10));
    }
}
