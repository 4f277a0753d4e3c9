//! The one trait a robot implements and the one macro that exports it.
//!
//! The macro emits the component's exports only when compiled to WebAssembly,
//! so that a native test or benchmark can link many robots side by side.

use crate::{Action, Briefing, Map, Sensors};

/// A controller that drives one match.
///
/// The host creates a fresh robot for every match with [`start`](Robot::start)
/// and then asks it for one action after another. Nothing survives a match, but
/// everything in `self` survives the reset between its two runs.
///
/// ```
/// use wasmouse_sdk::{Action, Briefing, Robot, Sensors, Turn, export_robot};
///
/// /// Drives straight ahead and never arrives.
/// struct Straight {
///     longest_move: i8,
/// }
///
/// impl Robot for Straight {
///     fn start(briefing: &Briefing) -> Self {
///         assert!(briefing.variant == 0, "this robot has no variants");
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
    /// A robot should panic on a variant it does not have, and may panic when it
    /// cannot take part; the match then ends with a fault in step 0.
    fn start(briefing: &Briefing) -> Self;

    /// Answers the readings at the current cell and heading. Called once a step.
    fn next_move(&mut self, sensors: Sensors) -> Action;

    /// What the robot knows about the walls, for tests: a native match holds it
    /// against the maze after every answer (`testing::MapAudit`). No part of the
    /// component. `None` by default, of a robot without a map or that shows none.
    fn map(&self) -> Option<&Map> {
        None
    }
}

/// Exports a type that implements [`Robot`] as a component.
///
/// Use it once in a crate of type `cdylib`. On targets other than `wasm32` it
/// only checks that the type is a [`Robot`].
///
/// Of the functions it exports, `next-move` traps when it is called before `start`.
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
                $crate::bindings::runtime::report_panics();
            }
        };

        #[cfg(not(target_arch = "wasm32"))]
        const _: () = {
            const fn is_a_robot<R: $crate::Robot>() {}
            is_a_robot::<$robot>();
        };
    };
}
