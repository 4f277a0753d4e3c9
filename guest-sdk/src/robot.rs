//! The trait that a robot implements and the macro that exports it.
//!
//! The macro emits exports only when compiled to WebAssembly, so that a native test or
//! benchmark can link many robots.

use crate::{Action, Briefing, Map, Sensors};

/// A controller that drives one match.
///
/// The host creates a new robot forevery match with [`start`](Robot::start) and then calls
/// [`next_move`](Robot::next_move) once per step. Nothing survives a match, but everything in
/// `self` survives the reset between the exploration run and the speed run.
///
/// ```
/// use wasmouse_sdk::{Action, Briefing, Robot, Sensors, Turn, export_robot};
///
/// /// Drives straight ahead and never reaches the goal.
/// struct Straight {
///     longest_move: i8,
/// }
///
/// impl Robot for Straight {
///     fn start(briefing: &Briefing) -> Self {
///         assert!(briefing.variant == 0, "this robot has only variant 0");
///         let longest_move = i8::try_from(briefing.longest_move).unwrap_or(i8::MAX);
///         Self { longest_move }
///     }
///
///     fn next_move(&mut self, _sensors: Sensors) -> Action {
///         Action::drive(Turn::Straight, self.longest_move)
///     }
/// }
///
/// export_robot!(Straight);
/// ```
pub trait Robot: Sized + 'static {
    /// Prepares for a match. Called once, before the first step.
    ///
    /// # Panics
    ///
    /// A robot should panic on a variant that it does not have, and may panic if it cannot
    /// take part. The match then ends with the fault `panic` in step 0.
    fn start(briefing: &Briefing) -> Self;

    /// Returns the action for the readings at the current position. Called once per step.
    fn next_move(&mut self, sensors: Sensors) -> Action;

    /// What the robot knows about the walls, for tests: a native match compares it with the
    /// maze after every step (`testing::MapAudit`). Not part of the component. `None` by
    /// default, for robots that have no map.
    fn map(&self) -> Option<&Map> {
        None
    }
}

/// Exports a type that implements [`Robot`] as a component.
///
/// Use it once in a crate of type `cdylib`. On targets other than `wasm32` it only checks
/// that the type is a [`Robot`].
///
/// A panic of the robot ends the match with the fault `panic`, with a message of the form
/// `MESSAGE (FILE:LINE:COLUMN)`. `next-move` panics if it is called before `start`.
#[macro_export]
macro_rules! export_robot {
    ($robot:ty) => {
        #[cfg(target_arch = "wasm32")]
        const _: () = {
            // A WebAssembly instance has one thread, so this is one plain static.
            std::thread_local! {
                static ROBOT: ::core::cell::RefCell<::core::option::Option<$robot>> =
                    const { ::core::cell::RefCell::new(::core::option::Option::None) };
            }

            struct Controller;

            impl $crate::bindings::exports::wasmouse::robot::controller::Guest for Controller {
                fn start(briefing: $crate::Briefing) {
                    let robot = <$robot as $crate::Robot>::start(&briefing);
                    ROBOT.with_borrow_mut(|slot| *slot = ::core::option::Option::Some(robot));
                }

                fn next_move(sensors: $crate::Sensors) -> $crate::Action {
                    ROBOT.with_borrow_mut(|slot| {
                        let robot = slot.as_mut().expect("start is called before next-move");
                        $crate::Robot::next_move(robot, sensors)
                    })
                }
            }

    $crate::bindings::export!(Controller with_types_in $crate::bindings);

            // Called once, while the component is instantiated.
            #[unsafe(export_name = "_initialize")]
            extern "C" fn initialize() {
                $crate::bindings::report_panics();
            }
        };

        #[cfg(not(target_arch = "wasm32"))]
        const _: () = {
            const fn is_a_robot<R: $crate::Robot>() {}
            is_a_robot::<$robot>();
        };
    };
}
