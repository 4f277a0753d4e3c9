// Colours of drawings, from the page's style sheet.

export interface Theme {
  ground: string;
  cell: string;
  wall: string;
  faint: string;
  fog: string;
  goal: string;
  start: string;
  heat: string;
  path: string;
  exploration: string;
  speed: string;
  robot: string;
  robotEdge: string;
  text: string;
  belief: string;
  wrong: string;
  beam: string;
}

const NAMES: (keyof Theme)[] = [
  "ground",
  "cell",
  "wall",
  "faint",
  "fog",
  "goal",
  "start",
  "heat",
  "path",
  "exploration",
  "speed",
  "robot",
  "robotEdge",
  "text",
  "belief",
  "wrong",
  "beam",
];

/** The colours in use at `element`. */
export function themeOf(element: Element): Theme {
  const style = getComputedStyle(element);
  const kebab = (name: string) => name.replace(/[A-Z]/g, (it) => `-${it.toLowerCase()}`);
  const entries = NAMES.map((name) => [name, style.getPropertyValue(`--m-${kebab(name)}`).trim()]);
  return Object.fromEntries(entries) as Theme;
}

/** The colours that a robot can paint with. Both themes have them, translucent. */
export const PAINT: Record<string, string> = {
  red: "#e5484d",
  orange: "#f76b15",
  yellow: "#e2a300",
  green: "#30a46c",
  cyan: "#00a2c7",
  blue: "#3e63dd",
  violet: "#8e4ec6",
  gray: "#8b8d98",
};
