/**
 * What a robot for wasmouse is made of: the interface and a toolkit.
 *
 * It has no dependencies and is part of your project, so change it as you like.
 */
export * from "./interface.js";
export * as journal from "./journal.js";
export * from "./map.js";
export * from "./pose.js";
export * from "./search.js";
export * from "./tracker.js";
