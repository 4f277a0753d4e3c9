// Renders a component again whenever the player changes.

import { useLayoutEffect, useState } from "preact/hooks";
import type { Player } from "./player";

export function usePlayer(player: Player): void {
  const [, setVersion] = useState(0);
  useLayoutEffect(() => player.subscribe(() => setVersion((it) => it + 1)), [player]);
}
