// The page: what its controls do, and what is drawn when.

import { Camera } from "./camera";
import { Chart } from "./chart";
import { channels, RangeChoice, Scale } from "./colours";
import { complain, element, input, select, showHeading, showTip, tableOf } from "./elements";
import { filmOf, pictureOf, recordedBy, save } from "./exports";
import { Field, fieldsOf, Mode, rangeOfFrame, rangeOfRun, valueOf } from "./fields";
import { followKeys, followPointer } from "./gestures";
import { blockRows, contactRows, pointRows, Row } from "./inspector";
import { plain, quantity, scaledUnit } from "./numbers";
import { markBlock, Overlay, OverlayContents, ROOM } from "./overlay";
import { cornerNumbersOf, nearestContact, pick } from "./pick";
import { Layout } from "./picture";
import { Lines, Renderer } from "./renderer";
import { Moment, Run } from "./run";
import { Sizes } from "./sizes";

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
    this.camera.sizeCanvas(this.renderer.canvas, isHurried ? this.ratio / 2 : this.ratio);
  }

  // --- what is drawn

  private get field(): Field {
    return this.fields[select("field").selectedIndex];
  }
  private get magnification(): number {
    return Number(input("magnify-number").value.replace(",", ".")) || 1;
  }

  /** Factor of the lengths of arrows and crosses. */
  private get arrows(): number {
    return 10 ** Number(input("arrows").value);
  }
  private get sizes(): Sizes {
    return new Sizes(this.layout!, this.run.head, this.camera.scale);
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
    const own = ["low", "high"].map((end) => factor * Number(input(end).value.replace("−", "-"))) as [number, number];
    if (choice === "own" && own.every(Number.isFinite)) ends = own;
    else {
      const least = 1e-4 * Math.max(Math.abs(ends[0]), Math.abs(ends[1]));
      ["low", "high"].forEach((end, k) => (input(end).value = Math.abs(ends[k]) < least ? "0" : plain(ends[k] / factor)));
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
    const forces = select("forces").value, crosses = select("crosses").value, arrows = this.arrows;
    fill("cells", input("cells").checked, (lines) => layout.cells(lines));
    fill("outlines", input("outlines").checked && !this.hasManyEdges, (lines) => layout.outlines(lines));
    fill("reference", input("reference").checked, (lines) => layout.reference(lines, this.camera.scale));
    fill("states", input("states").checked, (lines) => layout.states(lines));
    fill("crosses", crosses !== "", (lines) => layout.crosses(lines, this.sizes.metresOfStress(crosses === "cell", arrows), crosses === "cell"));
    fill("forces", forces !== "", (lines) => layout.forces(lines, this.sizes.metresOfForce(arrows), this.camera.scale, forces !== "contact"));
    fill("thrust", forces === "thrust", (lines) => layout.thrust(lines));
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
    const forces = select("forces").value, alpha = this.sizes.outlineAlpha;
    const force = forces === "" ? 0 : this.sizes.metresOfForce(this.arrows);
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
      forceOfPixels: force > 0 ? 1 / (force * this.camera.scale) : null,
      stressOfPixels: null,
    };
    this.overlay.draw(this.camera, this.ratio, contents, this.chosenBlock < 0 ? null : (context) => markBlock(context, layout, this.chosenBlock, this.camera));
    ++this.framesDrawn;
    if (this.pointer && !this.isPlaying) this.tip(...this.pointer);
  }
  fit(): void {
    if (!this.layout) return;
    const { low, high } = this.layout.box;
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
    this.camera.sizeCanvas(this.renderer.canvas, this.isHurried ? this.ratio / 2 : this.ratio);
    this.camera.sizeCanvas(this.overlay.canvas, this.ratio);
    this.chart?.drawStill();
    if (!isFirst && this.layout) this.drawNow();
  }

  // --- values

  /** The rows of what lies at a point of the picture, or null. */
  valuesAt(px: number, py: number): { name: string; rows: Row[] } | null {
    if (!this.layout) return null;
    const { layout } = this, [x, y] = this.camera.toWorld(px, py), picked = pick(layout, x, y);
    const contact = nearestContact(layout, x, y, 7 / this.camera.scale);
    if (!picked && contact === null) return null;
    const rows = picked ? pointRows(this.run, layout, picked, input("smooth").checked) : [];
    if (contact !== null) rows.push(...contactRows(this.run, layout, contact));
    return { name: picked ? "block " + this.run.blockName(picked.block) : "", rows };
  }
  private tip(px: number, py: number): void {
    const values = this.valuesAt(px, py);
    showTip(values?.name ?? "", values?.rows ?? null, [px, py], [this.camera.width, this.camera.height]);
  }
  chooseAt(px: number, py: number): void {
    const picked = this.layout && pick(this.layout, ...this.camera.toWorld(px, py));
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
    return recordedBy(element("film"), filmOf([this.renderer.canvas, this.overlay.canvas], this.run.nFrames,
      Number(select("speed").value), async (frame) => {
        await this.show(frame);
        this.drawNow();
      }, () => !this.isRecording)).finally(() => (this.isRecording = false));
  }

  // --- controls

  private setUpHistories(): Chart | null {
    const { histories, colours } = this.run.head;
    if (histories.length === 0) {
      element("chart").style.display = element("history-label").style.display = "none";
      return null;
    }
    const chart = new Chart(element("chart"), colours.lines, (time) => {
      this.pause();
      this.show(this.run.frameNear(time)).catch(complain);
    });
    chart.offer(histories, select("history"));
    return chart;
  }

  private setUpPage(): void {
    const { head } = this.run;
    showHeading(head.title, head.program, head.verdict);
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
    followKeys({ " ": toggle, ArrowLeft: () => go(this.wanted - 1), ArrowRight: () => go(this.wanted + 1), Home: () => go(0),
                 End: () => go(this.run.nFrames - 1), f: () => this.fit() });
    new ResizeObserver(() => this.resize()).observe(element("stage"));
    this.resize();
  }
  private fileName(ending: string): string {
    const title = this.run.head.title.replace(/[^\p{L}\p{N}]+/gu, "_").slice(0, 60) || "run";
    return ending === "png" ? `${title}_${this.field.name}_step${this.moment?.step}.png` : `${title}_${this.field.name}.webm`;
  }

  private setUpPointer(): void {
    followPointer(element("stage"), {
      zoom: (factor, x, y) => {
        this.camera.zoom(factor, x, y);
        this.viewChanged();
      },
      pan: (dx, dy) => {
        this.camera.pan(dx, dy);
        element("tip").hidden = true;
        this.draw();
      },
      move: (x, y) => (this.pointer = [x, y]),
      hover: (x, y) => this.tip(x, y),
      choose: (x, y) => this.chooseAt(x, y),
      leave: () => {
        this.pointer = null;
        element("tip").hidden = true;
      },
      fit: () => this.fit(),
    });
  }
}

try {
  const viewer = new Viewer();
  (window as unknown as { viewer: Viewer }).viewer = viewer; // scripts and tests drive the page by it
  viewer.show(viewer.run.nFrames - 1).catch(complain);
} catch (error) {
  complain(error);
}
