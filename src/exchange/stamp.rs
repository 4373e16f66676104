//! Time stamp of a report. The library does not read the clock; its caller does.

use std::fmt;

/// Time at which a check ended, and its duration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stamp {
    /// Seconds since the beginning of 1970, in UTC.
    pub seconds: u64,
    /// Duration of the check in seconds.
    pub took: f64,
}

/// Last second of the year 9999, the last that ISO 8601 writes with four digits.
const LATEST: u64 = 253_402_300_799;

impl fmt::Display for Stamp {
    /// ISO 8601 format, in UTC, without a zone: `2026-03-01T09:30:00`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seconds = self.seconds.min(LATEST);
        let (mut days, time) = (seconds / 86_400, seconds % 86_400);
        let leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
        let mut year = 1970;
        while days >= 365 + u64::from(leap(year)) {
            days -= 365 + u64::from(leap(year));
            year += 1;
        }
        let february = 28 + u64::from(leap(year));
        let mut month = 1;
        for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30] {
            if days < length {
                break;
            }
            days -= length;
            month += 1;
        }
        let (hour, minute, second) = (time / 3600, time / 60 % 60, time % 60);
        write!(f, "{year:04}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}", days + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::Stamp;

    #[test]
    fn dates_are_those_of_the_calendar() {
        let text = |seconds| Stamp { seconds, took: 0.0 }.to_string();
        assert_eq!(text(0), "1970-01-01T00:00:00");
        assert_eq!(text(951_782_399), "2000-02-28T23:59:59");
        assert_eq!(text(951_782_400), "2000-02-29T00:00:00");
        assert_eq!(text(1_709_164_800), "2024-02-29T00:00:00");
        assert_eq!(text(1_735_689_599), "2024-12-31T23:59:59");
        assert_eq!(text(1_772_357_400), "2026-03-01T09:30:00");
        assert_eq!(text(4_107_542_399), "2100-02-28T23:59:59");
        assert_eq!(text(4_107_542_400), "2100-03-01T00:00:00");
        assert_eq!(text(253_402_300_799), "9999-12-31T23:59:59");
        assert_eq!(text(253_402_300_800), "9999-12-31T23:59:59");
        assert_eq!(text(u64::MAX), "9999-12-31T23:59:59");
    }
}
