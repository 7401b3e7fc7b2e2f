// What is written on the picture: caption, colour bar, scale bar, legends. A canvas, so that exports have it.

import { Camera } from "./camera";
import { COMPRESSION, FORCE, Scale, STATE_COLOURS, TENSION, THRUST } from "./colours";
import { Mode } from "./fields";
import { plain, quantity, roundStep, scaledUnit, ticks } from "./numbers";
import { Layout } from "./picture";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', Roboto, sans-serif";
const INK = "#1c242c", SOFT = "#5b6875";

/** The room that legends take beside the picture, CSS pixels. */
export const ROOM = { right: 104, bottom: 40, top: 30 };

const CAPTION_HEIGHT = 30;

export interface OverlayContents {
  caption: string;
  scale: Scale | null;
  rangeNote: string[];
  kinds: { colour: string; name: string }[];
  showStates: boolean;
  showCrosses: boolean;
  showThrust: boolean;
  forceOfPixels: number | null; // N/m of one pixel of an arrow
  stressOfPixels: number | null;
}

function css(colour: [number, number, number]): string {
  return `rgb(${colour.join(",")})`;
}

export class Overlay {
  private readonly context: CanvasRenderingContext2D;
  private look = ""; // of all but the caption, as it was drawn last
  constructor(readonly canvas: HTMLCanvasElement) {
    this.context = canvas.getContext("2d")!;
  }

  draw(camera: Camera, ratio: number, contents: OverlayContents, decorate: ((c: CanvasRenderingContext2D) => void) | null): void {
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.textBaseline = "middle";
    const look = JSON.stringify([camera, ratio, { ...contents, caption: "", scale: null }, contents.scale?.field.name, contents.scale?.ends,
                                 this.canvas.width, this.canvas.height]);
    const onlyCaption = look === this.look && !decorate; // while playing: less to draw
    c.clearRect(0, 0, camera.width, onlyCaption ? CAPTION_HEIGHT : camera.height);
    this.look = decorate ? "" : look;
    decorate?.(c);
    c.font = `13px ${FONT}`;
    this.label(contents.caption, 16, 18, INK);
    if (onlyCaption) return;
    if (contents.scale && contents.scale.field.mode > Mode.kind) this.colourBar(camera, contents.scale, contents.rangeNote);
    else this.kinds(camera, contents.kinds);
    this.bottomLine(camera, contents);
  }

  /** Text that reads on anything. */
  private label(text: string, x: number, y: number, colour: string, align: CanvasTextAlign = "left"): void {
    const c = this.context;
    c.textAlign = align;
    c.lineJoin = "round";
    c.lineWidth = 4;
    c.strokeStyle = "rgba(255,255,255,0.9)";
    c.strokeText(text, x, y);
    c.fillStyle = colour;
    c.fillText(text, x, y);
  }

  private colourBar(camera: Camera, scale: Scale, note: string[]): void {
    const c = this.context, width = 16, x = camera.width - ROOM.right + 14, top = 58;
    const height = Math.max(80, Math.min(340, camera.height - top - 110));
    const [factor, unit] = scaledUnit(Math.max(Math.abs(scale.low), Math.abs(scale.high)), scale.field.unit);
    const y = (value: number) => top + height * (1 - (value - scale.low) / (scale.high - scale.low));
    for (let row = 0; row < height; ++row) {
      c.fillStyle = scale.colour(scale.high + ((row + 0.5) / height) * (scale.low - scale.high));
      c.fillRect(x, top + row, width, 1.5);
    }
    c.strokeStyle = "#8895a2";
    c.lineWidth = 1;
    c.strokeRect(x - 0.5, top - 0.5, width + 1, height + 1);
    c.font = `600 13px ${FONT}`;
    this.label(scale.field.label.split("  ")[0] + (unit ? ` (${unit})` : ""), x, top - 18, INK);
    c.font = `12px ${FONT}`;
    for (const value of ticks(scale.low / factor, scale.high / factor, 7)) {
      c.fillStyle = SOFT;
      c.fillRect(x + width + 1, y(value * factor) - 0.5, 4, 1);
      this.label(plain(value), x + width + 9, y(value * factor), INK);
    }
    c.font = `10.5px ${FONT}`;
    note.forEach((line, k) => this.label(line, camera.width - 10, top + height + 16 + 14 * k, SOFT, "right"));
  }

  private kinds(camera: Camera, kinds: { colour: string; name: string }[]): void {
    const c = this.context, x = camera.width - ROOM.right + 8;
    c.font = `12px ${FONT}`;
    kinds.slice(0, 12).forEach(({ colour, name }, k) => {
      c.fillStyle = colour;
      c.fillRect(x, 50 + 20 * k, 13, 13);
      c.strokeStyle = "#8895a2";
      c.lineWidth = 1;
      c.strokeRect(x, 50 + 20 * k, 13, 13);
      this.label(name.length > 12 ? name.slice(0, 11) + "…" : name, x + 19, 57 + 20 * k, INK);
    });
  }

  /** A scale bar and samples of what is drawn on the blocks. */
  private bottomLine(camera: Camera, contents: OverlayContents): void {
    const c = this.context, y = camera.height - 18;
    c.font = `12px ${FONT}`;
    const metres = roundStep(90 / camera.scale, 1), length = metres * camera.scale > 150 ? (metres * camera.scale) / 2 : metres * camera.scale;
    c.fillStyle = INK;
    c.fillRect(16, y - 0.75, length, 1.5);
    c.fillRect(16, y - 4, 1.5, 8);
    c.fillRect(16 + length - 1.5, y - 4, 1.5, 8);
    let x = 16 + length + 7;
    const text = (words: string) => {
      this.label(words, x, y, INK);
      x += c.measureText(words).width + 20;
    };
    text(lengthText(length / camera.scale));
    const line = (colour: [number, number, number], width: number, words: string) => {
      c.fillStyle = css(colour);
      c.fillRect(x, y - width / 2, 18, width);
      x += 24;
      text(words);
    };
    if (contents.forceOfPixels) {
      const force = roundStep(contents.forceOfPixels * 30, 1), pixels = force / contents.forceOfPixels;
      c.fillStyle = css(FORCE);
      c.fillRect(x, y - 0.8, pixels - 7, 1.6);
      c.beginPath();
      c.moveTo(x + pixels, y);
      c.lineTo(x + pixels - 8, y - 3.2);
      c.lineTo(x + pixels - 8, y + 3.2);
      c.fill();
      x += pixels + 6;
      text(quantity(force, "N/m"));
    }
    if (contents.showStates) for (const state of ["stick", "slip", "open"]) line(STATE_COLOURS[state], 3.2, state);
    if (contents.showCrosses) {
      line(COMPRESSION, 1.8, "compression");
      line(TENSION, 1.8, "tension");
    }
    if (contents.showThrust) line(THRUST, 2.4, "line of thrust");
  }
}

function lengthText(metres: number): string {
  return metres >= 0.1 ? plain(metres) + "\u202fm" : metres >= 1e-3 ? plain(metres * 1000) + "\u202fmm" : quantity(metres, "m");
}

/** The outline of a block that was chosen. */
export function markBlock(context: CanvasRenderingContext2D, layout: Layout, block: number, camera: Camera): void {
  const { shape } = layout.moment;
  if (!layout.isPresent(block)) return;
  context.beginPath();
  for (let p = shape.firstPlace[block]; p < shape.firstPlace[block] + shape.nVertices[block]; ++p)
    context.lineTo(...camera.toScreen(layout.position[2 * p], layout.position[2 * p + 1]));
  context.closePath();
  for (const [width, colour] of [[5.5, "#fff"], [2.5, "#000"]] as const) {
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.stroke();
  }
}
