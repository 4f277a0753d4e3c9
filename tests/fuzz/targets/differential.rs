#![no_main]

wasmouse_fuzz::target!("differential");
