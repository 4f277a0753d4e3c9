//! The panic hook of robots.

/// Makes every panic end the match with the fault `panic` and a message of the form
/// `MESSAGE (FILE:LINE:COLUMN)`, in place of a bare trap.
///
/// [`export_robot!`](crate::export_robot) calls it while the robot is instantiated, so it
/// uses no fuel of `start` or `next-move`.
#[cfg(target_arch = "wasm32")]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|panic| {
        let message = panic.payload_as_str().unwrap_or("panic");
        let message = match panic.location() {
            Some(location) => format!("{message} ({location})"),
            None => message.to_owned(),
        };
        super::generated::wasmouse::robot::journal::panic(&message);
    }));
}
