//! [`backtrace`]: where a robot was in its code when it failed, as text.

use wasmouse_core::guest_text::GuestStr;
use wasmouse_engine::{Frame, FramePart};

use super::escape::for_terminal;

/// The frames, most recent call first, one line each; those of a runtime or an interpreter that
/// follow each other are one line. The first line names the robot and, if it is known, the line of
/// source code that failed. Does not end with a newline.
pub fn backtrace<'a>(robot: impl Into<GuestStr<'a>>, frames: &[Frame]) -> String {
    let parts = Frame::folded(frames);
    let own = parts.iter().find_map(|part| match part {
        FramePart::Frame(frame) => frame.source.as_ref(),
        FramePart::Folded { .. } => None,
    });
    let mut lines = format!("backtrace of `{}`", for_terminal(robot));
    if let Some(source) = own {
        lines.push_str(&format!(", failed at {}", for_terminal(source)));
    }
    lines.push_str(" (most recent call first):");
    for (depth, part) in parts.iter().enumerate() {
        match part {
            FramePart::Frame(frame) => {
                let function = for_terminal(&frame.function);
                lines.push_str(&format!("\n  {depth:>2}: {function}"));
                if let Some(source) = &frame.source {
                    lines.push_str(&format!(" at {}", for_terminal(source)));
                } else if let Some(offset) = frame.offset {
                    lines.push_str(&format!(" at offset {offset:#x}"));
                }
            }
            FramePart::Folded { of, frames } => {
                let plural = if *frames == 1 { "frame" } else { "frames" };
                lines.push_str(&format!("\n      ... {frames} {plural} of {}", of.name()));
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use wasmouse_core::GuestText;

    use super::*;

    #[test]
    fn runtimes_are_one_line_and_the_own_source_comes_first() {
        let frame = |function: &str, source: Option<&str>| Frame {
            function: function.into(),
            offset: Some(0x1f),
            source: source.map(GuestText::from),
        };
        let frames = [
            frame(
                "core::panicking::panic_fmt",
                Some("core/src/panicking.rs:80:14"),
            ),
            frame("core::panicking::panic", None),
            frame("robot::plan\u{1b}", Some("src/lib.rs:12:5")),
            frame("next-move", None),
        ];
        let expected = "backtrace of `a\\nb`, failed at src/lib.rs:12:5 (most recent call first):\n      \
                        ... 2 frames of the Rust runtime\n   1: robot::plan\\u{1b} at \
                        src/lib.rs:12:5\n   2: next-move at offset 0x1f";
        assert_eq!(backtrace("a\nb", &frames), expected);
    }
}
