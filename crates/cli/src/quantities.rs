//! Numbers, times and amounts of memory, as options take them.

use std::time::Duration;

/// Reads `90`, `500ms`, `30s`, `5m` or `1h`.
pub(crate) fn parse_duration(text: &str) -> Result<Duration, String> {
    let split = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let factor = match unit {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ if number.is_empty() => return Err("write a number of seconds, or 500ms, 30s, 5m or 1h".to_owned()),
        _ => return Err(format!("unknown unit `{unit}`; write 500ms, 30s, 5m or 1h")),
    };
    let number: f64 = number.parse().map_err(|_| "write a number of seconds, or 500ms, 30s, 5m or 1h".to_owned())?;
    Duration::try_from_secs_f64(number * factor).map_err(|e| e.to_string())
}

/// Reads a number as every option takes them.
pub(crate) fn parse_whole(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("write a whole number from 0 to {}", u64::MAX))
}

/// Reads an amount of memory in bytes: `200`, which are mebibytes, `500M`, `2G`, `512MiB` or `2GB`. As in GNU's tools,
/// `M` and `MiB` count in powers of 1024 and `MB` in powers of 1000; small letters do as well.
pub(crate) fn parse_bytes(text: &str) -> Result<u64, String> {
    let nonsense = || "write a whole number of mebibytes, or one with a unit: 500M, 2G, 512MiB, 2GB".to_owned();
    let split = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let factor: u64 = match unit.to_ascii_uppercase().as_str() {
        "B" => 1,
        "K" | "KIB" => 1 << 10,
        "" | "M" | "MIB" => 1 << 20,
        "G" | "GIB" => 1 << 30,
        "T" | "TIB" => 1 << 40,
        "KB" => 1_000,
        "MB" => 1_000_000,
        "GB" => 1_000_000_000,
        "TB" => 1_000_000_000_000,
        _ => return Err(nonsense()),
    };
    let number: u64 = number.parse().map_err(|_| nonsense())?;
    // More than can be counted is more than there is.
    Ok(number.saturating_mul(factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations() {
        assert_eq!(parse_duration("90"), Ok(Duration::from_secs(90)));
        assert_eq!(parse_duration("500ms"), Ok(Duration::from_millis(500)));
        assert_eq!(parse_duration("1.5m"), Ok(Duration::from_secs(90)));
        assert!(
            parse_duration("5 parsecs").is_err() && parse_duration("").is_err() && parse_duration("1e999").is_err()
        );
    }

    #[test]
    fn amounts_of_memory() {
        for (text, bytes) in [
            ("0", 0),
            ("200", 200 << 20),
            ("64K", 64 << 10),
            ("500M", 500 << 20),
            ("500MiB", 500 << 20),
            ("500MB", 500_000_000),
            ("2G", 2 << 30),
            ("2gib", 2 << 30),
            ("2gb", 2_000_000_000),
            ("1T", 1 << 40),
            ("4096b", 4096),
            ("18446744073709551615T", u64::MAX),
        ] {
            assert_eq!(parse_bytes(text), Ok(bytes), "{text}");
        }
        for text in ["", "G", "-1", "1.5G", "2 G", "2X", "lots", "99999999999999999999"] {
            assert!(parse_bytes(text).is_err_and(|message| message.contains("500M, 2G")), "{text}");
        }
    }
}
