// Icons of buttons; their meaning is in the label of the button.

const PATHS = {
  play: "M7 4.5v15l12.5-7.5z",
  pause: "M6 4.5h4.5v15H6zM13.5 4.5H18v15h-4.5z",
  first: "M5 5h2.5v14H5zM19 5v14l-10-7z",
  last: "M16.5 5H19v14h-2.5zM5 5l10 7-10 7z",
  back: "M15.5 5.5 8 12l7.5 6.5z",
  forward: "M8.5 5.5 16 12l-7.5 6.5z",
  previous: "M12 5.5 5.5 12l6.5 6.5zM19 5.5 12.5 12l6.5 6.5z",
  next: "M5 5.5 11.5 12 5 18.5zM12 5.5l6.5 6.5-6.5 6.5z",
  close: "m6.4 5 5.6 5.6L17.6 5 19 6.4 13.4 12l5.6 5.6-1.4 1.4-5.6-5.6L6.4 19 5 17.6l5.6-5.6L5 6.4z",
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true" focusable="false">
      <path d={PATHS[name]} />
    </svg>
  );
}

/** A button with an icon; `label` says what it does, `key` which key does it as well. */
export function IconButton(props: {
  icon: IconName;
  label: string;
  shortcut?: string;
  class?: string;
  /** Whether it has the focus when the dialog opens. */
  autofocus?: boolean;
  onClick: () => void;
}) {
  const title = props.shortcut ? `${props.label} (${props.shortcut})` : props.label;
  return (
    <button
      type="button"
      class={`w-button ${props.class ?? ""}`}
      title={title}
      aria-label={props.label}
      autofocus={props.autofocus ?? false}
      onClick={props.onClick}
    >
      <Icon name={props.icon} />
    </button>
  );
}
