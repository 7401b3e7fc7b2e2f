// What the pointer and the keys do.

/** Places are in pixels from the upper left corner of the stage. */
export interface PointerActions {
  zoom(factor: number, x: number, y: number): void;
  pan(dx: number, dy: number): void;
  move(x: number, y: number): void;
  /** Moves without a button pressed. */
  hover(x: number, y: number): void;
  choose(x: number, y: number): void;
  leave(): void;
  fit(): void;
}

/** Pixels that a click may move. */
const STILL = 4;

export function followPointer(stage: HTMLElement, actions: PointerActions): void {
  let last: [number, number] | null = null, moved = 0;
  const at = (event: MouseEvent): [number, number] => {
    const box = stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    actions.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...at(event));
  }, { passive: false });
  stage.addEventListener("pointerdown", (event) => {
    last = at(event);
    moved = 0;
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener("pointermove", (event) => {
    const now = at(event);
    actions.move(...now);
    if (!last) return actions.hover(...now);
    const [dx, dy] = [now[0] - last[0], now[1] - last[1]];
    moved += Math.hypot(dx, dy);
    last = now;
    actions.pan(dx, dy);
  });
  stage.addEventListener("pointerup", (event) => {
    if (last && moved < STILL) actions.choose(...at(event));
    last = null;
  });
  stage.addEventListener("pointerleave", () => actions.leave());
  stage.addEventListener("dblclick", () => actions.fit());
}

/** Keys by their names, where they do not belong to a field of the page. */
export function followKeys(actions: Record<string, () => void>): void {
  document.addEventListener("keydown", (event) => {
    if ((event.target as HTMLElement).matches("input:not([type=range]):not([type=checkbox]), select")) return;
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    action();
  });
}
