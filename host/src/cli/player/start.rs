//! [`play`]: the player, on a terminal.

use std::time::Duration;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::terminal;
use super::super::tui;
use super::control::Player;
use super::show::Show;

/// How matches are shown.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// Time for a step.
    pub delay: Duration,
    /// The position to begin at.
    pub position: usize,
    /// Whether it plays from there at once.
    pub playing: bool,
    /// Whether to use ASCII only.
    pub ascii: bool,
    /// What needs a terminal, in the message that there is none: a command or an option.
    pub what: &'a str,
    /// What to do about that.
    pub hint: &'a str,
}

/// Shows one match, or several side by side in lockstep, until the viewer quits.
///
/// # Errors
///
/// When there are no matches or more than four, when standard output is not a terminal, or when
/// it is lost.
pub fn play(shows: Vec<Show>, options: &Options<'_>) -> Result<Exit, Failure> {
    if shows.is_empty() || shows.len() > 4 {
        let count = shows.len();
        let message = format!("{} shows from 1 to 4 matches, found {count}", options.what);
        return Err(Failure::usage(message));
    }
    let mut player = Player::with_look(shows, terminal::look(options.ascii));
    player.set_delay(options.delay);
    player.seek(options.position);
    player.is_playing = options.playing;
    tui::run(&mut player, options.what, options.hint)
}
