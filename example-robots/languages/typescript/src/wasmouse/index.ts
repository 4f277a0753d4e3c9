/**
 * What a robot for wasmouse is made of: the interface and a toolkit.
 *
 * It has no dependencies and is part of your project, so change it as you like.
 */

export * from "./interface";
export * as journal from "./journal";
export * from "./map";
export * from "./pose";
export * from "./search";
export * from "./tracker";
