//! Where results come from: the program and the machine.

/// The program and the machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Environment {
    /// The version of typelift.
    pub version: String,
    /// The commit that it was built from, if it was built in a repository.
    pub commit: Option<String>,
    /// The processor, with the number of its threads.
    pub cpu: String,
    /// The operating system and the architecture.
    pub system: String,
}

impl Environment {
    /// This program on this machine.
    pub fn of_this_machine() -> Self {
        let name = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| cpu_name(&text));
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("TYPELIFT_COMMIT").map(str::to_owned),
            cpu: format!("{}, {threads} threads", name.unwrap_or_else(|| "unknown".to_owned())),
            system: format!("{system}, {architecture}"),
        }
    }
}

fn cpu_name(cpuinfo: &str) -> Option<String> {
    let line = cpuinfo.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processors_name() {
        let text = "processor\t: 0\nmodel name\t: A CPU @ 2.80GHz\nmodel name\t: other\n";
        assert_eq!(cpu_name(text).as_deref(), Some("A CPU @ 2.80GHz"));
        assert_eq!(cpu_name(""), None);
        assert!(Environment::of_this_machine().cpu.ends_with(" threads"));
    }
}
