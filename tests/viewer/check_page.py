"""Pages of `dda view` in headless Chromium: they load, play, pick and export without an error in the console.

    check_page.py DDA DIRECTORY

Pages and pictures of them stay in DIRECTORY.
"""

import os
import subprocess
import sys

import chromium


def make_page(dda, directory, kind, *settings):
    scene, result = (os.path.join(directory, kind + ending) for ending in (".toml", "-out"))
    page = os.path.join(directory, kind + ".html")
    subprocess.run([dda, "make", kind, "-o", scene], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([dda, "run", scene, "-o", result, "--force", "--quiet", *settings], check=True)
    subprocess.run([dda, "view", result, "-o", page], check=True)
    return page


def expect(is_so, what):
    if not is_so:
        raise SystemExit("not so: " + what)


def choose(page, name, value):
    kind = "checked" if isinstance(value, bool) else "value"
    page.value(f"(() => {{ const e = document.getElementById('{name}'); e.{kind} = {str(value).lower() if isinstance(value, bool) else repr(value)};"
               " e.dispatchEvent(new Event('input')); })()")


def check(page, path, picture):
    page.open(path)
    page.wait_for("window.viewer && viewer.framesDrawn > 0")
    n = page.value("viewer.run.nFrames")
    expect(n > 3, "the page has several frames")
    expect(page.value("viewer.moment.index") == n - 1, "the page opens with the last frame")

    # Every field and every overlay.
    for field in page.value("viewer.fields.map(f => f.name)"):
        choose(page, "field", field)
        page.value("viewer.drawNow()")
    for name in ("cells", "reference", "states"):
        choose(page, name, True)
    for forces in ("contact", "joint", "thrust"):
        choose(page, "forces", forces)
    for crosses in ("block", "cell"):
        choose(page, "crosses", crosses)
    for chosen in ("frame", "extremes", "run"):
        choose(page, "range", chosen)
    page.value("viewer.drawNow()")
    for name in ("cells", "reference"):
        choose(page, name, False)
    choose(page, "crosses", "")
    choose(page, "field", "s2")

    # Keys and playing.
    page.key("Home")
    page.wait_for("viewer.moment.index === 0")
    page.key("ArrowRight")
    page.wait_for("viewer.moment.index === 1")
    page.value("(async () => { document.getElementById('speed').value = '60'; await viewer.show(0); viewer.play(); })()")
    page.wait_for("viewer.moment.index >= 3")
    page.key(" ", "Space")
    page.wait_for("document.getElementById('play').textContent.includes('Play')")
    page.key("End")
    page.wait_for(f"viewer.moment.index === {n - 1}")

    # What lies under the pointer, in the middle of the last block.
    block = page.value("viewer.moment.shape.nBlocks") - 1
    x, y = page.value(f"""(() => {{ const box = document.getElementById('stage').getBoundingClientRect();
        const [x, y] = viewer.camera.toScreen(...viewer.layout.middle({block})); return [x + box.left, y + box.top]; }})()""")
    page.pointer("mouseMoved", x, y)
    name = page.value(f"viewer.run.blockName({block})")
    page.wait_for("!document.getElementById('tip').hidden")
    tip = page.value("document.getElementById('tip').textContent")
    for words in ("block " + name, "σ₁", "Pa", "ux, uy"):
        expect(words in tip, f'the pointer tells "{words}": {tip}')
    page.click(x, y)
    page.wait_for(f"document.getElementById('block-title').textContent === 'Block {name}'")
    expect("joint with" in page.value("document.getElementById('block-rows').textContent"), "a block tells its joints")

    # Exports: the picture has colours, the film has bytes.
    colours = page.value("""(async () => { const picture = await createImageBitmap(await viewer.picture());
        const canvas = new OffscreenCanvas(picture.width, picture.height), c = canvas.getContext('2d');
        c.drawImage(picture, 0, 0);
        return new Set(new Uint32Array(c.getImageData(0, 0, picture.width, picture.height).data.buffer)).size; })()""")
    expect(colours > 50, f"the picture has many colours, not {colours}")
    expect(page.value("viewer.film().then(film => film.size)") > 1000, "the film has bytes")
    page.screenshot(picture)
    expect(not page.errors, "no error in the console: " + "\n".join(page.errors))


def main(dda, directory):
    if not chromium.program():
        print("skipped: there is no Chromium")
        return 0
    os.makedirs(directory, exist_ok=True)
    with chromium.Page() as page:
        for kind, *settings in (("arch", "--steps", "6"), ("column", "--steps", "6"), ("joints", "--steps", "4")):
            path = make_page(dda, directory, kind, *settings)
            check(page, path, os.path.join(directory, kind + ".png"))
            print(kind, "is shown")
    return 0


sys.exit(main(*sys.argv[1:]))
