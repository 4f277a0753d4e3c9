// The player: a dialog over the page.

import { useLayoutEffect, useRef } from "preact/hooks";
import { Compare, KeyHelp, OverlayChoice, Transport } from "./controls";
import { Facts, Logs } from "./facts";
import { IconButton } from "./icons";
import { handleKey } from "./keys";
import type { Library } from "./library";
import { Pane } from "./pane";
import type { Player } from "./player";
import { visible } from "./text";
import { Events, Timeline } from "./timeline";
import { usePlayer } from "./use-player";

export function Dialog(props: { player: Player; library: Library; onClose: () => void }) {
  const { player, library, onClose } = props;
  usePlayer(player);
  const dialog = useRef<HTMLDialogElement>(null);
  const isOpen = player.panes.length > 0 || player.problem !== null;
  // Before anything is painted, so that keys that follow at once reach the player.
  useLayoutEffect(() => {
    if (isOpen) {
      dialog.current?.showModal();
    } else {
      dialog.current?.close();
    }
  }, [isOpen]);
  const first = player.panes[0];
  return (
    <dialog
      ref={dialog}
      class="w-dialog"
      aria-labelledby="w-title"
      onCancel={(event) => {
        event.preventDefault();
        onClose();
      }}
      onKeyDown={(event) => {
        if (handleKey(player, event)) {
          event.preventDefault();
        }
      }}
    >
      {isOpen && (
        <div class="w-player">
          <header class="w-head">
            <h2 id="w-title">{first ? visible(first.source.maze, 200) || "Replay" : "Replay"}</h2>
            {first && (
              <span class="w-note">
                {first.match.about.dimension} × {first.match.about.dimension}, seed {visible(first.source.seed, 30)}
              </span>
            )}
            <IconButton icon="close" label="Close the player" shortcut="Esc" class="w-close" onClick={onClose} />
          </header>
          {player.problem !== null && (
            <p class="w-problem" role="alert">
              {visible(player.problem)}
            </p>
          )}
          {first && (
            <>
              <div class="w-panes" data-count={player.panes.length}>
                {player.panes.map((pane, index) => (
                  <Pane key={index} player={player} library={library} pane={pane} index={index} />
                ))}
              </div>
              <div class="w-bottom">
                <Timeline player={player} />
                <Transport player={player} />
              </div>
              <div class="w-side" tabIndex={0} role="group" aria-label="Details">
                <Compare player={player} library={library} />
                <OverlayChoice player={player} />
                <Facts player={player} />
                <Logs player={player} />
                <Events player={player} />
                <KeyHelp />
              </div>
            </>
          )}
          <p class="w-hidden" role="status">
            {visible(player.announcement, 500)}
          </p>
        </div>
      )}
    </dialog>
  );
}
