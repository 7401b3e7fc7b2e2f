// Pictures and films of what is shown.

/** Offers a file for download. */
export function save(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** Lays canvases on each other. */
export function compose(target: HTMLCanvasElement, layers: HTMLCanvasElement[]): void {
  target.width = layers[0].width & ~1; // films want even sizes
  target.height = layers[0].height & ~1;
  const c = target.getContext("2d")!;
  c.fillStyle = "#fff";
  c.fillRect(0, 0, target.width, target.height);
  for (const layer of layers) c.drawImage(layer, 0, 0);
}

export function pictureOf(layers: HTMLCanvasElement[]): Promise<Blob> {
  const canvas = document.createElement("canvas");
  compose(canvas, layers);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the browser made no picture"))), "image/png"));
}

/**
 * Shows frame after frame and records them.
 * `show` draws frame k and resolves when it is on the canvases; `framesPerSecond` of them are filmed.
 */
export async function filmOf(layers: HTMLCanvasElement[], nFrames: number, framesPerSecond: number,
                             show: (frame: number) => Promise<void>, isStopped: () => boolean): Promise<Blob> {
  const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((t) => MediaRecorder.isTypeSupported(t));
  if (!type) throw new Error("this browser records no WebM films; use Chromium or Firefox");
  const canvas = document.createElement("canvas");
  compose(canvas, layers);
  const recorder = new MediaRecorder(canvas.captureStream(Math.max(10, framesPerSecond)), { mimeType: type, videoBitsPerSecond: 12e6 });
  const parts: Blob[] = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const ended = new Promise<void>((resolve) => (recorder.onstop = () => resolve()));
  recorder.start(500);
  for (let frame = 0; frame < nFrames && !isStopped(); ++frame) {
    const due = performance.now() + 1000 / framesPerSecond;
    await show(frame);
    compose(canvas, layers);
    await new Promise((resolve) => setTimeout(resolve, Math.max(0, due - performance.now())));
  }
  await new Promise((resolve) => setTimeout(resolve, 300)); // the last frame is to be seen
  for (let tries = 0; tries < 50 && parts.every((part) => part.size === 0); ++tries) { // the encoder has not begun yet
    compose(canvas, layers);
    await new Promise((resolve) => setTimeout(resolve, 100));
    recorder.requestData();
  }
  recorder.stop();
  await ended;
  return new Blob(parts, { type: "video/webm" });
}

/** The button offers to stop as long as a film is recorded. */
export async function recordedBy(button: HTMLElement, film: Promise<Blob>): Promise<Blob> {
  const say = (isRecording: boolean, text: string) => {
    button.setAttribute("aria-pressed", String(isRecording));
    button.textContent = text;
  };
  say(true, "Stop recording");
  return film.finally(() => say(false, "Record film"));
}
