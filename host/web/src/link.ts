// Links to a step: `#ROBOT/MAZE/SEED/STEP`, parts percent-encoded; several matches that are
// compared are joined by `+`.

export interface Place {
  robot: string;
  maze: string;
  /** In decimal. */
  seed: string;
  step: number;
}

export function formatLink(places: Place[]): string {
  const part = (it: Place) =>
    [it.robot, it.maze, it.seed, String(it.step)].map(encode).join("/");
  return `#${places.map(part).join("+")}`;
}

/** Percent-encoded, but for the colon between a robot and its variant, which is no separator here. */
function encode(text: string): string {
  return encodeURIComponent(text.replace(/\p{Cs}/gu, "\ufffd")).replaceAll("%3A", ":");
}

/** The places of a link, or none if it is that of a section or anything else. */
export function parseLink(hash: string): Place[] {
  if (!hash.startsWith("#") || !hash.includes("/")) {
    return [];
  }
  const places: Place[] = [];
  for (const part of hash.slice(1).split("+").slice(0, 4)) {
    const fields = part.split("/");
    if (fields.length < 3 || fields.length > 4) {
      return [];
    }
    try {
      const [robot, maze, seed, step] = fields.map(decodeURIComponent);
      const isNumber = /^\d{1,9}$/.test(step ?? "0");
      if (robot === undefined || maze === undefined || seed === undefined || !isNumber) {
        return [];
      }
      places.push({ robot, maze, seed, step: Number(step ?? "0") });
    } catch {
      return [];
    }
  }
  return places;
}
