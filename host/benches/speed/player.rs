//! The terminal player: a whole screen of it.

use criterion::Criterion;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use wasmouse::cli::player::{Player, Show};
use wasmouse_core::game::{Action, GameRules};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Color, Journal, Level, Note};
use wasmouse_core::maze::{Cell, Maze, Turn};
use wasmouse_core::playback::Playback;
use wasmouse_core::record::{Transcript, trace};

use super::stage;

/// `player/...`: the last of 1,000 steps in a 16 x 16 maze at 200 x 60, where a picture needs most.
pub fn bench(criterion: &mut Criterion) {
    let (_, maze) = stage::generated("gen:tree:16:1").swap_remove(0);
    let mut group = criterion.benchmark_group("player");
    for (name, shows) in [("one", 1), ("two", 2)] {
        let shows = (0..shows).map(|_| Show::new("robot", "maze", wandering(&maze)));
        let mut player = Player::new(shows.collect(), true);
        player.seek(1000);
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut buffer = Buffer::empty(Rect::new(0, 0, 200, 60));
                player.render(&mut buffer);
                buffer
            });
        });
    }
    group.finish();
}

/// A robot that wanders for 1,000 steps and writes all the time.
fn wandering(maze: &Maze) -> Playback {
    let rules = GameRules::default();
    let mut transcript = Transcript::default();
    let mut journal = Journal::default();
    journal.clear(1 << 20);
    for step in 0..1000_u32 {
        let turn = [
            Turn::Left,
            Turn::Straight,
            Turn::Right,
            Turn::Straight,
            Turn::Right,
        ];
        let turn = turn[(step * step / 7) as usize % turn.len()];
        transcript.push(Action::Move { turn, advance: 3 });
        let place = |number: u32| u8::try_from(number % 16).expect("below 16");
        let cell = Cell::new(place(step), place(step / 16));
        let label = step.to_string();
        let (text, color, level) = (GuestStr::from(&label), Color::Green, Level::Info);
        journal.push(step, Note::Label { cell, text });
        journal.push(step, Note::Paint { cell, color });
        journal.push(step, Note::Log { level, text });
    }
    let (result, trace) = trace(maze, &rules, &transcript).expect("a whole match");
    Playback::new(maze.clone(), rules, trace, result.verdict, journal)
}
