// The page: what its controls do, and what is drawn when.

import { Camera } from "./camera";
import { Chart } from "./chart";
import { channels, RangeChoice, Scale } from "./colours";
import { filmOf, pictureOf, save } from "./exports";
import { Field, fieldsOf, Mode, rangeOfFrame, rangeOfRun, valueOf } from "./fields";
import { blockRows, contactRows, pointRows, Row } from "./inspector";
import { plain, quantity, scaledUnit } from "./numbers";
import { Overlay, OverlayContents, ROOM } from "./overlay";
import { cornerNumbersOf, nearestContact, pick } from "./pick";
import { Layout } from "./picture";
import { Lines, Renderer } from "./renderer";
import { History, Moment, Run } from "./run";

function element<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}
const input = (id: string) => element<HTMLInputElement>(id);
const select = (id: string) => element<HTMLSelectElement>(id);

function complain(error: unknown): void {
  const message = element("message");
  message.hidden = false;
  message.textContent = String(error instanceof Error ? error.message : error);
  console.error(error);
}

/** Edges of outlines that are drawn as boxes, with soft borders; more of them are plain lines. */
const MOST_FINE_EDGES = 15000;

/** The page with its run. */
class Viewer {
  readonly run = new Run();
  readonly camera = new Camera();
  readonly renderer = new Renderer(element("blocks"));
  readonly overlay = new Overlay(element("overlay"));
  readonly fields = fieldsOf(this.run.head);
  readonly chart: Chart | null;
  private readonly lines = new Lines();
  private ratio = 1;
  private layout: Layout | null = null;
  private scale: Scale | null = null;
  private shapeShown = -1;
  private hasManyEdges = false;
  private isHurried = false; // playing too slowly: what is fine and small is left out
  private wanted = -1; // the frame to be shown
  private isPlaying = false;
  private isRecording = false;
  private chosenBlock = -1;
  private isDrawingDue = false;
  private pointer: [number, number] | null = null;
  framesDrawn = 0; // for tests and measurements

  constructor() {
    this.chart = this.setUpHistories();
    this.setUpPage();
    this.setUpControls();
    this.setUpPointer();
  }

  get moment(): Moment | null {
    return this.layout ? this.layout.moment : null;
  }

  // --- frames

  async show(index: number): Promise<void> {
    index = Math.max(0, Math.min(this.run.nFrames - 1, index));
    this.wanted = index;
    const moment = await this.run.moment(index);
    if (this.wanted !== index) return; // another one has been requested since
    const isFirst = !this.layout;
    this.setLayout(moment);
    if (isFirst) this.fit();
    input("slider").value = String(index);
    element("moment").textContent = `${index + 1}/${this.run.nFrames}   step ${moment.step},  t = ${plain(moment.time, 4)} s`;
    this.chart?.mark(moment.time);
    this.draw();
    const ahead = Math.min(this.run.nFrames - 1, index + 6);
    if (this.isPlaying) this.run.prepare(ahead);
  }

  private setLayout(moment: Moment): void {
    this.layout = new Layout(moment, this.magnification);
    if (moment.shape.id !== this.shapeShown) {
      this.shapeShown = moment.shape.id;
      this.renderer.setTriangles(moment.shape.triangles);
      const edges = this.layout.edges();
      this.hasManyEdges = edges.length > 2 * MOST_FINE_EDGES;
      this.renderer.setEdges(edges);
    }
    if (this.hasManyEdges) this.renderer.setPlaces(this.layout.position);
    this.renderer.setPositions(this.layout.cornerPositions());
    this.updateColours();
    this.updateLines();
    this.updateBlock();
  }

  async play(): Promise<void> {
    if (this.isPlaying || this.run.nFrames < 2) return;
    this.isPlaying = true;
    element("play").textContent = "❚❚ Pause";
    let index = this.wanted >= this.run.nFrames - 1 ? 0 : this.wanted, due = performance.now();
    let pace = 0; // ms a frame takes, a running mean
    while (this.isPlaying) {
      const start = performance.now();
      await this.show(index);
      due = Math.max(due + 1000 / Number(select("speed").value), performance.now() - 100);
      do await new Promise(requestAnimationFrame);
      while (this.isPlaying && performance.now() < due - 4);
      pace += (performance.now() - start - pace) / 8;
      if (!this.isHurried && pace > 1.2 * Math.max(33, 1000 / Number(select("speed").value))) this.hurry(true);
      if (++index < this.run.nFrames) continue;
      if (!input("loop").checked) break;
      index = 0;
    }
    this.pause();
  }
  pause(): void {
    this.isPlaying = false;
    element("play").textContent = "▶ Play";
    this.hurry(false);
    this.draw();
  }

  /** Draws blocks coarsely, where the drawing is slow, and finely again. */
  private hurry(isHurried: boolean): void {
    if (isHurried === this.isHurried) return;
    this.isHurried = isHurried;
    this.sizeCanvas(this.renderer.canvas, isHurried ? this.ratio / 2 : this.ratio);
  }
  private sizeCanvas(canvas: HTMLCanvasElement, ratio: number): void {
    canvas.width = Math.max(1, Math.round(this.camera.width * ratio));
    canvas.height = Math.max(1, Math.round(this.camera.height * ratio));
  }

  // --- what is drawn

  private get field(): Field {
    return this.fields[select("field").selectedIndex];
  }
  private get magnification(): number {
    return Number(input("magnify-number").value.replace(",", ".")) || 1;
  }

  private updateColours(): void {
    const { moment, field } = this;
    if (!moment) return;
    const { head } = this.run, { colours } = head, choice = select("range").value as RangeChoice;
    const numbers = cornerNumbersOf(moment, field.source, input("smooth").checked);
    const values = new Float32Array(numbers.length / 3);
    for (let k = 0; k < values.length; ++k) values[k] = valueOf(field.mode, numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]);
    this.renderer.setValues(values);
    if (field.mode === Mode.kind || field.mode === Mode.none) {
      this.scale = null;
      const table = field.mode === Mode.none ? ["#fff"] : colours.kinds;
      this.renderer.setColours(table.map(channels), false, field.mode !== Mode.none, [0, Math.max(1, table.length - 1)]);
      element("ends").hidden = true;
      return;
    }
    const [low, high, robustLow, robustHigh] = choice === "frame" ? rangeOfFrame(field, numbers) : rangeOfRun(field, head);
    let ends: [number, number] = choice === "extremes" ? [low, high] : [robustLow, robustHigh];
    const [factor, unit] = scaledUnit(Math.max(Math.abs(ends[0]), Math.abs(ends[1])), field.unit);
    if (choice === "own") ends = [factor * Number(input("low").value.replace("−", "-")), factor * Number(input("high").value.replace("−", "-"))];
    else {
      const least = 1e-4 * Math.max(Math.abs(ends[0]), Math.abs(ends[1]));
      input("low").value = Math.abs(ends[0]) < least ? "0" : plain(ends[0] / factor);
      input("high").value = Math.abs(ends[1]) < least ? "0" : plain(ends[1] / factor);
    }
    element("ends").hidden = false;
    element("ends-unit").textContent = unit;
    this.scale = new Scale(field, ends[0], ends[1], head);
    this.renderer.setColours(this.scale.table.map(channels), true, true, this.scale.ends);
    const between = { run: "1–99 % of all frames", frame: "1–99 % of this frame", extremes: "all values", own: "as given" }[choice];
    this.rangeNote = [between, "min " + quantity(low, field.unit), "max " + quantity(high, field.unit)];
  }
  private rangeNote: string[] = [];

  /** Lines under their names, made anew. */
  private updateLines(): void {
    const layout = this.layout;
    if (!layout) return;
    const fill = (name: string, isShown: boolean, make: (lines: Lines) => void) => {
      this.lines.clear();
      if (isShown) make(this.lines);
      this.renderer.setLines(name, this.lines);
    };
    const forces = select("forces").value, crosses = select("crosses").value;
    fill("cells", input("cells").checked, (lines) => layout.cells(lines));
    fill("outlines", input("outlines").checked && !this.hasManyEdges, (lines) => layout.outlines(lines));
    fill("reference", input("reference").checked, (lines) => layout.reference(lines, this.camera.scale));
    fill("states", input("states").checked, (lines) => layout.states(lines));
    fill("crosses", crosses !== "", (lines) => layout.crosses(lines, this.metresOfStress, crosses === "cell"));
    fill("forces", forces !== "", (lines) => layout.forces(lines, this.metresOfForce, this.camera.scale, forces !== "contact"));
    fill("thrust", forces === "thrust", (lines) => layout.thrust(lines));
  }

  /** How long the arrow of 1 N/m is: the 99th percentile of all forces takes 46 px. */
  private get metresOfForce(): number {
    const { force } = this.run.head;
    return force > 0 ? (46 * 10 ** Number(input("arrows").value)) / force / this.camera.scale : 0;
  }
  private get metresOfStress(): number {
    const { s1, s2 } = this.run.head.ranges;
    if (!s1) return 0;
    const most = Math.max(Math.abs(s1[2]), Math.abs(s1[3]), Math.abs(s2[2]), Math.abs(s2[3]));
    return most > 0 ? (this.pixelsOfPart * 10 ** Number(input("arrows").value)) / most / this.camera.scale : 0;
  }
  /** About as large as a block, or a cell, is drawn. */
  private get pixelsOfPart(): number {
    const layout = this.layout!, { shape } = layout.moment, { low, high } = this.box;
    const n = select("crosses").value === "cell" ? shape.blockOfCell.length : shape.nBlocks;
    return Math.min(60, Math.max(5, 0.8 * this.camera.scale * Math.sqrt(((high[0] - low[0]) * (high[1] - low[1])) / n)));
  }
  private get box(): { low: [number, number]; high: [number, number] } {
    return this.layout!.box;
  }

  /** Outlines of blocks that are drawn small must not hide the colours. */
  private get outlineAlpha(): number {
    const { shape } = this.layout!.moment, { low, high } = this.box;
    const size = this.camera.scale * Math.sqrt(((high[0] - low[0]) * (high[1] - low[1])) / Math.max(1, shape.nBlocks));
    return Math.max(0.1, Math.min(0.8, (size - 4) / 22));
  }

  draw(): void {
    if (this.isDrawingDue) return;
    this.isDrawingDue = true;
    requestAnimationFrame(() => this.drawNow());
  }
  drawNow(): void {
    this.isDrawingDue = false;
    const { layout, moment } = this;
    if (!layout || !moment) return;
    const forces = select("forces").value, alpha = this.outlineAlpha;
    const edgeAlpha = this.hasManyEdges && !this.isHurried && input("outlines").checked ? alpha : 0;
    this.renderer.draw(this.camera, this.ratio, edgeAlpha, [["reference", 1], ["cells", alpha], ["outlines", alpha], ["states", 1],
      ["crosses", 1], ["thrust", 1], ["forces", 1]]);
    const times = this.magnification === 1 ? "" : `,  displacements × ${plain(this.magnification)}`;
    const contents: OverlayContents = {
      caption: `${this.run.head.title}   ·   step ${moment.step},  t = ${plain(moment.time, 4)} s${times}`,
      scale: this.scale,
      rangeNote: this.rangeNote,
      kinds: this.field.name === "material" ? this.run.head.materials.map((name, k) => ({ name, colour: this.run.head.colours.kinds[k % 8] })) : [],
      showStates: input("states").checked,
      showCrosses: select("crosses").value !== "",
      showThrust: forces === "thrust",
      forceOfPixels: forces !== "" && this.metresOfForce > 0 ? 1 / (this.metresOfForce * this.camera.scale) : null,
      stressOfPixels: null,
    };
    this.overlay.draw(this.camera, this.ratio, contents, this.chosenBlock < 0 ? null : (context) => this.markBlock(context, layout));
    ++this.framesDrawn;
    if (this.pointer && !this.isPlaying) this.tip(...this.pointer);
  }
  private markBlock(context: CanvasRenderingContext2D, layout: Layout): void {
    const { shape } = layout.moment, block = this.chosenBlock;
    if (block < 0 || !layout.isPresent(block)) return;
    context.beginPath();
    for (let p = shape.firstPlace[block]; p < shape.firstPlace[block] + shape.nVertices[block]; ++p)
      context.lineTo(...this.camera.toScreen(layout.position[2 * p], layout.position[2 * p + 1]));
    context.closePath();
    for (const [width, colour] of [[5.5, "#fff"], [2.5, "#000"]] as const) {
      context.lineWidth = width;
      context.strokeStyle = colour;
      context.stroke();
    }
  }

  fit(): void {
    if (!this.layout) return;
    const { low, high } = this.box;
    this.camera.fit(low, high, ROOM.right, ROOM.bottom, ROOM.top);
    this.viewChanged();
  }
  private viewChanged(): void {
    if (input("reference").checked || select("forces").value !== "" || select("crosses").value !== "") this.updateLines();
    this.draw();
  }
  resize(): void {
    const stage = element("stage"), isFirst = this.camera.width === 1;
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    this.camera.width = stage.clientWidth;
    this.camera.height = stage.clientHeight;
    this.sizeCanvas(this.renderer.canvas, this.isHurried ? this.ratio / 2 : this.ratio);
    this.sizeCanvas(this.overlay.canvas, this.ratio);
    this.chart?.drawStill();
    if (!isFirst && this.layout) this.drawNow();
  }

  // --- values

  /** The rows of what lies at a point of the picture, or null. */
  valuesAt(px: number, py: number): { name: string; rows: Row[] } | null {
    const { layout } = this;
    if (!layout) return null;
    const [x, y] = this.camera.toWorld(px, py), picked = pick(layout, x, y);
    const contact = nearestContact(layout, x, y, 7 / this.camera.scale);
    if (!picked && contact === null) return null;
    const rows = picked ? pointRows(this.run, layout, picked, input("smooth").checked) : [];
    if (contact !== null) rows.push(...contactRows(this.run, layout, contact));
    return { name: picked ? "block " + this.run.blockName(picked.block) : "", rows };
  }
  private tip(px: number, py: number): void {
    const tip = element("tip"), values = this.valuesAt(px, py);
    tip.hidden = !values;
    if (!values) return;
    tip.innerHTML = "";
    const name = document.createElement("b");
    name.textContent = values.name;
    tip.append(name, tableOf(values.rows));
    const { width, height } = this.camera;
    tip.style.left = Math.max(4, Math.min(px + 16, width - tip.offsetWidth - 6)) + "px";
    tip.style.top = Math.max(4, py + 16 + tip.offsetHeight > height ? py - tip.offsetHeight - 12 : py + 16) + "px";
  }
  chooseAt(px: number, py: number): void {
    const { layout } = this;
    if (!layout) return;
    const picked = pick(layout, ...this.camera.toWorld(px, py));
    this.chosenBlock = picked ? picked.block : -1;
    this.updateBlock();
    this.draw();
  }
  private updateBlock(): void {
    if (this.chosenBlock < 0 || !this.layout) return;
    element("block-title").textContent = "Block " + this.run.blockName(this.chosenBlock);
    element("block-rows").replaceChildren(tableOf(blockRows(this.run, this.layout, this.chosenBlock)));
  }

  // --- exports

  picture(): Promise<Blob> {
    this.hurry(false);
    this.drawNow();
    return pictureOf([this.renderer.canvas, this.overlay.canvas]);
  }
  async film(): Promise<Blob> {
    this.pause();
    this.drawNow();
    this.isRecording = true;
    element("film").setAttribute("aria-pressed", "true");
    element("film").textContent = "Stop recording";
    try {
      return await filmOf([this.renderer.canvas, this.overlay.canvas], this.run.nFrames, Number(select("speed").value),
        async (frame) => {
          await this.show(frame);
          this.drawNow();
        }, () => !this.isRecording);
    } finally {
      this.isRecording = false;
      element("film").setAttribute("aria-pressed", "false");
      element("film").textContent = "Record film";
    }
  }

  // --- controls

  private setUpHistories(): Chart | null {
    const { histories, colours } = this.run.head, groups = [...new Set(histories.map((curve) => curve.group))];
    if (groups.length === 0) {
      element("chart").style.display = element("history-label").style.display = "none";
      return null;
    }
    const chart = new Chart(element("chart"), colours.lines, (time) => {
      this.pause();
      this.show(this.frameNear(time)).catch(complain);
    });
    for (const group of groups) select("history").append(new Option(group));
    const choose = () => chart.show(histories.filter((curve) => curve.group === select("history").value));
    select("history").onchange = choose;
    select("history").value = mostMoving(histories) ?? groups[groups.length - 1];
    choose();
    return chart;
  }
  private frameNear(time: number): number {
    const { frames } = this.run.head;
    let nearest = 0;
    frames.forEach(([, t], k) => {
      if (Math.abs(t - time) < Math.abs(frames[nearest][1] - time)) nearest = k;
    });
    return nearest;
  }

  private setUpPage(): void {
    const { head } = this.run;
    document.title = head.title + " – " + head.program;
    element("title").textContent = head.title;
    for (const line of head.verdict) {
      const chip = document.createElement("span");
      chip.textContent = chip.title = line.length > 70 ? line.slice(0, 69) + "…" : line;
      chip.title = line;
      if (line === "at rest") chip.className = "good";
      if (/^(not at rest|warning|stopped|interrupted)/.test(line)) chip.className = "bad";
      element("verdict").append(chip);
    }
    for (const field of this.fields) select("field").append(new Option(field.label.replace("  ", " – "), field.name));
    if (this.fields.some((field) => field.name === "s2")) select("field").value = "s2";
    input("slider").max = String(this.run.nFrames - 1);
    const n = this.run.nFrames;
    select("speed").value = n > 90 ? "30" : n > 40 ? "15" : n > 20 ? "10" : "5";
    if (!head.arrays.stress) select("crosses").disabled = input("smooth").disabled = true;
  }

  private setUpControls(): void {
    const go = (index: number) => {
      this.pause();
      this.show(index).catch(complain);
    };
    const toggle = () => (this.isPlaying ? this.pause() : void this.play().catch(complain));
    element("play").onclick = toggle;
    element("first").onclick = () => go(0);
    element("back").onclick = () => go(this.wanted - 1);
    element("next").onclick = () => go(this.wanted + 1);
    element("last").onclick = () => go(this.run.nFrames - 1);
    input("slider").oninput = () => go(Number(input("slider").value));
    element("fit").onclick = () => this.fit();
    const again = () => {
      if (!this.moment) return;
      this.setLayout(this.moment);
      this.draw();
    };
    for (const id of ["outlines", "cells", "reference", "states", "forces", "crosses", "arrows", "field", "range", "smooth"]) {
      element(id).addEventListener("input", () => {
        if (id === "field" && select("range").value === "own") select("range").value = "run";
        again();
      });
    }
    for (const id of ["low", "high"])
      input(id).onchange = () => {
        select("range").value = "own";
        again();
      };
    input("magnify").oninput = () => {
      const factor = 10 ** Number(input("magnify").value);
      input("magnify-number").value = plain(factor, 2);
      again();
    };
    input("magnify-number").onchange = () => {
      input("magnify").value = String(Math.log10(Math.max(1, this.magnification)));
      again();
    };
    element("picture").onclick = () =>
      this.picture().then((blob) => save(blob, this.fileName("png"))).catch(complain);
    element("film").onclick = () => {
      if (this.isRecording) this.isRecording = false;
      else this.film().then((blob) => save(blob, this.fileName("webm"))).catch(complain);
    };
    document.addEventListener("keydown", (event) => {
      if ((event.target as HTMLElement).matches("input:not([type=range]):not([type=checkbox]), select")) return;
      const action = { " ": toggle, ArrowLeft: () => go(this.wanted - 1), ArrowRight: () => go(this.wanted + 1), Home: () => go(0),
                       End: () => go(this.run.nFrames - 1), f: () => this.fit() }[event.key];
      if (!action || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      action();
    });
    new ResizeObserver(() => this.resize()).observe(element("stage"));
    this.resize();
  }
  private fileName(ending: string): string {
    const title = this.run.head.title.replace(/[^\p{L}\p{N}]+/gu, "_").slice(0, 60) || "run";
    return ending === "png" ? `${title}_${this.field.name}_step${this.moment?.step}.png` : `${title}_${this.field.name}.webm`;
  }

  private setUpPointer(): void {
    const stage = element("stage");
    let last: [number, number] | null = null, moved = 0;
    const at = (event: MouseEvent): [number, number] => {
      const box = stage.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.camera.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...at(event));
      this.viewChanged();
    }, { passive: false });
    stage.addEventListener("pointerdown", (event) => {
      last = at(event);
      moved = 0;
      stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("pointermove", (event) => {
      const now = at(event);
      this.pointer = now;
      if (last) {
        moved += Math.hypot(now[0] - last[0], now[1] - last[1]);
        this.camera.pan(now[0] - last[0], now[1] - last[1]);
        last = now;
        element("tip").hidden = true;
        this.draw();
      } else this.tip(...now);
    });
    stage.addEventListener("pointerup", (event) => {
      if (last && moved < 4) this.chooseAt(...at(event));
      last = null;
    });
    stage.addEventListener("pointerleave", () => {
      this.pointer = null;
      element("tip").hidden = true;
    });
    stage.addEventListener("dblclick", () => this.fit());
  }
}

/** The displacements of monitors that change most. */
function mostMoving(histories: History[]): string | null {
  let most = 0, group: string | null = null;
  for (const curve of histories)
    if (/^monitors: u/.test(curve.group))
      for (const value of curve.values)
        if (Math.abs(value) > most) [most, group] = [Math.abs(value), curve.group];
  return group;
}

function tableOf(rows: Row[]): HTMLTableElement {
  const table = document.createElement("table");
  for (const [name, value] of rows) {
    const row = table.insertRow();
    row.insertCell().textContent = name;
    row.insertCell().textContent = value;
  }
  return table;
}

try {
  const viewer = new Viewer();
  (window as unknown as { viewer: Viewer }).viewer = viewer; // scripts and tests drive the page by it
  viewer.show(viewer.run.nFrames - 1).catch(complain);
} catch (error) {
  complain(error);
}
