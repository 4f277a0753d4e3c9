//! [`Theme`]: light or dark, and the style sheets of both.

/// The colours of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    /// What the reader prefers: light, or dark on a screen. For SVG only; pixels are light.
    #[default]
    Auto,
    /// Dark on white.
    Light,
    /// Light on near-black.
    Dark,
}

/// The rules of the light theme, which the dark one changes.
macro_rules! light {
    () => {
        "\
.maze-ground{fill:#fff}.maze-start{fill:#3e7bfa;fill-opacity:.3}
.maze-goal{fill:#30a46c;fill-opacity:.3}
.maze-heat{fill:none;stroke:#e5484d;stroke-width:20;shape-rendering:crispEdges}
.maze-wall{fill:none;stroke:#1b1c20;stroke-width:2;stroke-linecap:round}
.maze-unknown{fill:none;stroke:#8b8d98;stroke-width:2;stroke-linecap:round;stroke-dasharray:0 5}
.maze-dot{fill:#8b8d98}
.maze-path{fill:none;stroke:#3e7bfa;stroke-width:3;stroke-linejoin:round;stroke-linecap:round}
.maze-stop{fill:none;stroke:#3e7bfa;stroke-width:9;stroke-linecap:round}
.maze-optimum{fill:none;stroke:#218358;stroke-width:7;stroke-linejoin:round;stroke-opacity:.55}
.maze-robot{fill:#d6409f;stroke:#fff;stroke-width:1}
.maze-text{font-family:ui-sans-serif,system-ui,sans-serif;text-anchor:middle;fill:#1b1c20}
.maze-on-path{stroke:#fff;stroke-width:2;stroke-linejoin:round}
"
    };
}

/// What the dark theme changes.
macro_rules! dark {
    () => {
        ".maze-ground{fill:#16171b}.maze-wall{stroke:#e8e8ec}
.maze-optimum{stroke:#3dd68c}.maze-text{fill:#f2f2f5}.maze-on-path,.maze-robot{stroke:#16171b}"
    };
}

/// The style sheet of all pictures. A page that [embeds](super::Picture::to_svg_element) some needs it
/// once; its classes begin with `maze-`, so that they are of no concern to the rest of the page.
pub const SVG_STYLE: &str = concat!(
    light!(),
    "@media screen and (prefers-color-scheme:dark){",
    dark!(),
    "}"
);

impl Theme {
    /// The style sheet of pictures in that theme.
    pub(in crate::report) const fn style(self) -> &'static str {
        match self {
            Self::Auto => SVG_STYLE,
            Self::Light => light!(),
            Self::Dark => concat!(light!(), dark!()),
        }
    }

    /// Rules for the light theme and what the dark one changes, as one style sheet of this theme.
    pub(in crate::report) fn of(self, light: &str, dark: &str) -> String {
        match self {
            Self::Auto => {
                format!("{light}@media screen and (prefers-color-scheme:dark){{{dark}}}")
            }
            Self::Light => light.to_owned(),
            Self::Dark => format!("{light}{dark}"),
        }
    }
}
