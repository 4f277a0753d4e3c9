//! The timeline: where in the match the viewer is, and where something happened.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use wasmouse_core::playback::MilestoneKind;

use super::super::tui::{Look, Role};

/// Draws a line with a mark for each milestone. `area` is one row.
pub fn draw<'a>(
    buffer: &mut Buffer,
    area: Rect,
    look: Look,
    (position, last): (usize, usize),
    marks: impl Iterator<Item = &'a (usize, MilestoneKind)>,
) {
    if area.width < 2 || area.height == 0 {
        return;
    }
    let parts = usize::from(area.width - 1);
    let column = |position: usize| {
        let part = (position.min(last) * parts + last / 2) / last.max(1);
        area.x + u16::try_from(part.min(parts)).expect("a column of the screen")
    };
    let here = column(position);
    let (done, ahead) = (look.either("━", "="), look.either("─", "-"));
    for x in area.x..area.right() {
        let (line, role) = if x <= here {
            (done, Role::Strong)
        } else {
            (ahead, Role::Faint)
        };
        buffer[(x, area.y)]
            .set_symbol(line)
            .set_style(look.style(role));
    }
    let mut marks: Vec<(usize, MilestoneKind)> = marks.copied().collect();
    // Where several share a column, the one that matters most is drawn last.
    marks.sort_by_key(|&(_, kind)| std::cmp::Reverse(kind));
    for (position, kind) in marks {
        if let Some((symbol, role)) = mark(kind) {
            buffer[(column(position), area.y)]
                .set_symbol(symbol)
                .set_style(look.style(role));
        }
    }
    let style = look.style(Role::Cursor);
    buffer[(here, area.y)].set_style(style);
}

/// How a milestone is marked; the end needs none.
const fn mark(kind: MilestoneKind) -> Option<(&'static str, Role)> {
    match kind {
        MilestoneKind::Certain => Some(("C", Role::Good)),
        MilestoneKind::GoalReached => Some(("G", Role::Good)),
        MilestoneKind::Reset => Some(("R", Role::Optimum)),
        MilestoneKind::IgnoredReset => Some(("!", Role::Bad)),
        MilestoneKind::Bump | MilestoneKind::Clamp => Some(("'", Role::Warning)),
        MilestoneKind::End => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::tui::testing::text_of;
    use super::*;

    #[test]
    fn marks_are_where_things_happened() {
        let look = Look {
            charset: crate::report::picture::Charset::Ascii,
            color: false,
        };
        let marks = [
            (50, MilestoneKind::GoalReached),
            (50, MilestoneKind::Bump),
            (70, MilestoneKind::Reset),
            (100, MilestoneKind::End),
        ];
        let line = |position, last| {
            let area = Rect::new(0, 0, 11, 1);
            let mut buffer = Buffer::empty(area);
            draw(&mut buffer, area, look, (position, last), marks.iter());
            text_of(&buffer)
        };
        assert_eq!(line(0, 100), "=----G-R---\n");
        assert_eq!(line(60, 100), "=====G=R---\n");
        assert_eq!(line(100, 100), "=====G=R===\n");
        assert_eq!(line(0, 0), "G----------\n", "a match without steps");
    }
}
