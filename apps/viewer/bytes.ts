// What the program packed: Base64 of zlib streams of integers. The writing side is ddacontact/page/.

declare class DecompressionStream implements GenericTransformStream { // TypeScript 4.8 does not know it
  constructor(format: "deflate");
  readonly readable: ReadableStream;
  readonly writable: WritableStream;
}

function bytesOfBase64(text: string): Uint8Array {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

/** Resolves when the browser has read the page to its end. */
function pageIsRead(): Promise<void> {
  if (document.readyState !== "loading") return Promise.resolve();
  return new Promise((resolve) => document.addEventListener("DOMContentLoaded", () => resolve(), { once: true }));
}

/** The bytes of the element with this id, inflated. */
export async function inflated(id: string): Promise<Uint8Array> {
  if (!document.getElementById(id)) await pageIsRead();
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page lacks its part "${id}": write it again with dda view`);
  const stream = new Blob([bytesOfBase64(element.textContent || "")]).stream();
  const buffer = await new Response(stream.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
  return new Uint8Array(buffer);
}

/** Reads integers one after the other: zigzag, seven bits a byte, the lowest first. */
export class IntegerReader {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}

  next(): number {
    const bytes = this.bytes;
    let byte = bytes[this.at++];
    let bits = byte & 0x7f;
    for (let shift = 7; byte & 0x80; shift += 7) {
      byte = bytes[this.at++];
      bits |= (byte & 0x7f) << shift;
    }
    return (bits >>> 1) ^ -(bits & 1);
  }
  /** As many as `next` would give; this is where a page spends its time. */
  fill(numbers: Int32Array): void {
    const bytes = this.bytes, n = numbers.length;
    let at = this.at;
    for (let k = 0; k < n; ++k) {
      let byte = bytes[at++], bits = byte & 0x7f;
      for (let shift = 7; byte > 127; shift += 7) {
        byte = bytes[at++];
        bits |= (byte & 0x7f) << shift;
      }
      numbers[k] = (bits >>> 1) ^ -(bits & 1);
    }
    this.at = at;
  }
  nextByte(): number {
    return this.bytes[this.at++];
  }
  /** `count` little-endian 32-bit numbers. */
  floats(count: number): Float32Array {
    const copy = this.bytes.slice(this.at, this.at + 4 * count);
    this.at += 4 * count;
    return new Float32Array(copy.buffer);
  }
}

/** Integers that were written as differences in time (bit 0 of the mode) and along items (bit 1). */
export class MomentDecoder {
  private readonly numbers: Int32Array;
  constructor(private readonly isFirst: Uint8Array, private readonly components: number) {
    this.numbers = new Int32Array(isFirst.length * components);
  }

  /** The next moment; the array is reused by the one after. */
  read(reader: IntegerReader): Int32Array {
    const { numbers, isFirst, components } = this;
    const mode = reader.nextByte(), inTime = mode & 1, alongItems = mode & 2;
    const change = new Int32Array(numbers.length);
    reader.fill(change);
    if (alongItems)
      for (let item = 1, k = components; item < isFirst.length; ++item)
        if (isFirst[item]) k += components;
        else for (const end = k + components; k < end; ++k) change[k] += change[k - components];
    if (inTime) for (let k = 0; k < numbers.length; ++k) numbers[k] += change[k];
    else numbers.set(change);
    return numbers;
  }
}
