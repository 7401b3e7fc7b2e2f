// A run as the page holds it: its head at once, its frames when they are requested.

import { inflated, IntegerReader, MomentDecoder } from "./bytes";

export interface History {
  name: string;
  unit: string;
  group: string;
  times: number[];
  values: number[];
}

/** What the program writes as JSON (ddacontact/page/page_data.cpp). */
export interface Head {
  title: string;
  program: string;
  verdict: string[];
  blockNames: string[];
  histories: History[];
  centre: [number, number];
  arrays: { displacement: boolean; velocity: boolean; stress: boolean };
  frames: [number, number][];
  chunks: [number, number][];
  ranges: { [field: string]: [number, number, number, number] };
  force: number;
  materials: string[];
  colours: { diverging: string[]; sequential: string[]; kinds: string[]; lines: string[] };
}

/** Blocks and their cells. Places are points of blocks, the vertices of a block's outline its first ones. */
export interface Shape {
  id: number;
  nBlocks: number;
  nPlaces: number;
  firstPlace: Int32Array; // of each block, and one more
  nVertices: Int32Array;
  material: Int32Array;
  firstCell: Int32Array; // of each block, and one more
  firstCorner: Int32Array; // of each cell, and one more
  cornerPlace: Int32Array;
  cellOfCorner: Int32Array;
  blockOfCell: Int32Array;
  triangles: Uint32Array; // corners
  reference: Float32Array; // of places, relative to the head's centre, m
}

/** Contacts that are closed at some time in a chunk. */
export interface ContactTable {
  count: number;
  place: Int32Array;
  edgeBlock: Int32Array;
}

export const CONTACT_STATES = ["absent", "open", "stick", "slip", "slip"];

/** A frame. */
export interface Moment {
  index: number;
  step: number;
  time: number;
  shape: Shape;
  displacement: Float32Array; // of places, from the reference
  velocity: Float32Array | null;
  stress: Float32Array | null; // 9 a cell: at its centre, change along x, along y (xx, yy, xy each)
  contacts: ContactTable;
  state: Uint8Array; // of each contact, as CONTACT_STATES counts
  direction: Int32Array; // of the normal out of the edge's block, 4096 a turn
  force: Float32Array; // normal and shear, on the vertex
  gap: Float32Array;
}

/** The normal of a contact, out of the edge's block. */
export function normalOf(moment: Moment, contact: number): [number, number] {
  const angle = (moment.direction[contact] / 4096) * 2 * Math.PI;
  return [Math.cos(angle), Math.sin(angle)];
}

function readShape(bytes: Uint8Array, id: number): Shape {
  const reader = new IntegerReader(bytes);
  const nBlocks = reader.next();
  const firstPlace = new Int32Array(nBlocks + 1), firstCell = new Int32Array(nBlocks + 1);
  const nVertices = new Int32Array(nBlocks), material = new Int32Array(nBlocks);
  for (let b = 0; b < nBlocks; ++b) {
    nVertices[b] = reader.next();
    firstPlace[b + 1] = firstPlace[b] + reader.next();
    firstCell[b + 1] = firstCell[b] + reader.next();
    material[b] = reader.next();
  }
  const nCells = firstCell[nBlocks];
  const firstCorner = new Int32Array(nCells + 1), blockOfCell = new Int32Array(nCells);
  const cornerPlace: number[] = [], cellOfCorner: number[] = [], triangles: number[] = [];
  for (let b = 0; b < nBlocks; ++b)
    for (let c = firstCell[b]; c < firstCell[b + 1]; ++c) {
      const n = reader.next(), first = cornerPlace.length;
      blockOfCell[c] = b;
      firstCorner[c + 1] = first + n;
      for (let k = 0, place = firstPlace[b]; k < n; ++k) {
        cornerPlace.push((place += reader.next()));
        cellOfCorner.push(c);
      }
      for (let k = 0; k < 3 * (n - 2); ++k) triangles.push(first + reader.next());
    }
  const nPlaces = firstPlace[nBlocks];
  return {
    id, nBlocks, nPlaces, firstPlace, nVertices, material, firstCell, firstCorner,
    cornerPlace: Int32Array.from(cornerPlace),
    cellOfCorner: Int32Array.from(cellOfCorner),
    blockOfCell,
    triangles: Uint32Array.from(triangles),
    reference: reader.floats(2 * nPlaces),
  };
}

function firstItems(firstOfGroup: Int32Array): Uint8Array {
  const isFirst = new Uint8Array(firstOfGroup[firstOfGroup.length - 1]);
  for (let g = 0; g + 1 < firstOfGroup.length; ++g)
    if (firstOfGroup[g] < firstOfGroup[g + 1]) isFirst[firstOfGroup[g]] = 1;
  return isFirst;
}

/** Numbers of groups of items as multiples of powers of two. */
class Track {
  private readonly decoder: MomentDecoder;
  private readonly step: Float64Array;
  constructor(reader: IntegerReader, private readonly first: Int32Array, private readonly components: number) {
    this.step = new Float64Array(first.length - 1);
    for (let g = 0, exponent = 0; g < this.step.length; ++g) this.step[g] = 2 ** (exponent += reader.next());
    this.decoder = new MomentDecoder(firstItems(first), components);
  }
  read(reader: IntegerReader): Float32Array {
    const multiples = this.decoder.read(reader), values = new Float32Array(multiples.length);
    for (let g = 0; g < this.step.length; ++g) {
      const step = this.step[g], end = this.first[g + 1] * this.components;
      for (let k = this.first[g] * this.components; k < end; ++k) values[k] = step * multiples[k];
    }
    return values;
  }
}

function eachAlone(n: number): Int32Array {
  return Int32Array.from({ length: n + 1 }, (_, k) => k);
}

function readContactTable(reader: IntegerReader): ContactTable {
  const count = reader.next();
  const place = new Int32Array(count), edgeBlock = new Int32Array(count);
  for (let k = 0, p = 0, b = 0; k < count; ++k) {
    place[k] = p += reader.next();
    edgeBlock[k] = b += reader.next();
  }
  return { count, place, edgeBlock };
}

/** Successive frames of one shape. They are read in order; what was read is kept. */
class Chunk {
  private readonly moments: Moment[] = [];
  private readonly reader: IntegerReader;
  private readonly displacement: Track;
  private readonly velocity: Track | null;
  private readonly stress: Track | null;
  private readonly contacts: ContactTable;
  private readonly states: MomentDecoder;
  private readonly force: Track;
  private readonly gap: Track;

  constructor(bytes: Uint8Array, private readonly shape: Shape, private readonly head: Head,
              private readonly firstFrame: number) {
    const reader = (this.reader = new IntegerReader(bytes));
    this.displacement = new Track(reader, shape.firstPlace, 2);
    this.velocity = head.arrays.velocity ? new Track(reader, shape.firstPlace, 2) : null;
    this.stress = head.arrays.stress ? new Track(reader, shape.firstCell, 9) : null;
    this.contacts = readContactTable(reader);
    const each = eachAlone(this.contacts.count);
    this.force = new Track(reader, each, 2);
    this.gap = new Track(reader, Int32Array.of(0, this.contacts.count), 1);
    this.states = new MomentDecoder(firstItems(each), 2);
  }

  moment(k: number): Moment {
    while (this.moments.length <= k) this.moments.push(this.readNext());
    return this.moments[k];
  }

  private readNext(): Moment {
    const index = this.firstFrame + this.moments.length, reader = this.reader, n = this.contacts.count;
    const displacement = this.displacement.read(reader);
    const velocity = this.velocity ? this.velocity.read(reader) : null;
    const stress = this.stress ? this.stress.read(reader) : null;
    const numbers = this.states.read(reader), state = new Uint8Array(n), direction = new Int32Array(n);
    for (let k = 0; k < n; ++k) {
      state[k] = numbers[2 * k];
      direction[k] = numbers[2 * k + 1];
    }
    const force = this.force.read(reader), gap = this.gap.read(reader);
    const [step, time] = this.head.frames[index];
    return { index, step, time, shape: this.shape, displacement, velocity, stress, contacts: this.contacts,
             state, direction, force, gap };
  }
}

const MOST_BYTES = 600e6; // of chunks that are kept

/** The run of this page. */
export class Run {
  readonly head: Head;
  private readonly shapes = new Map<number, Promise<Shape>>();
  private readonly chunks = new Map<number, Promise<Chunk>>();
  private readonly firstFrame: number[] = [];

  constructor() {
    this.head = JSON.parse(document.getElementById("head")!.textContent!);
    let first = 0;
    for (const [, count] of this.head.chunks) {
      this.firstFrame.push(first);
      first += count;
    }
  }

  get nFrames(): number {
    return this.head.frames.length;
  }
  /** The frame nearest to a time. */
  frameNear(time: number): number {
    const { frames } = this.head;
    let nearest = 0;
    frames.forEach(([, t], k) => {
      if (Math.abs(t - time) < Math.abs(frames[nearest][1] - time)) nearest = k;
    });
    return nearest;
  }
  blockName(block: number): string {
    return this.head.blockNames[block] ?? String(block);
  }

  async moment(index: number): Promise<Moment> {
    const chunk = this.chunkOf(index);
    return (await this.loaded(chunk)).moment(index - this.firstFrame[chunk]);
  }
  /** Starts to read what is needed soon. */
  prepare(index: number): void {
    this.loaded(this.chunkOf(index)).catch(() => undefined); // told when the frame itself is requested
  }

  private chunkOf(index: number): number {
    let chunk = 0;
    while (chunk + 1 < this.firstFrame.length && this.firstFrame[chunk + 1] <= index) ++chunk;
    return chunk;
  }
  private shape(id: number): Promise<Shape> {
    if (!this.shapes.has(id)) this.shapes.set(id, inflated("shape" + id).then((bytes) => readShape(bytes, id)));
    return this.shapes.get(id)!;
  }
  private loaded(chunk: number): Promise<Chunk> {
    const known = this.chunks.get(chunk);
    if (known) {
      this.chunks.delete(chunk); // the last used is the last in the order of the map
      this.chunks.set(chunk, known);
      return known;
    }
    const [shapeId] = this.head.chunks[chunk];
    const loading = Promise.all([this.shape(shapeId), inflated("chunk" + chunk)]).then(([shape, bytes]) => {
      this.forget(shape);
      return new Chunk(bytes, shape, this.head, this.firstFrame[chunk]);
    });
    loading.catch(() => this.chunks.delete(chunk)); // the page may not be read that far yet
    this.chunks.set(chunk, loading);
    return loading;
  }
  /** Drops the chunks that were not used for longest. */
  private forget(shape: Shape): void {
    const bytesOfChunk = 8 * (16 * shape.nPlaces + 36 * shape.blockOfCell.length + 40 * shape.nPlaces);
    const most = Math.max(3, Math.floor(MOST_BYTES / bytesOfChunk));
    for (const oldest of this.chunks.keys()) {
      if (this.chunks.size <= most) return;
      this.chunks.delete(oldest);
    }
  }
}
