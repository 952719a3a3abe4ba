"use strict";

/** The gallery: puts on the page what the walk says. */
class Gallery {
  constructor(data) {
    this.data = data;
    this.walk = new GalleryWalk(data);
    this.strip = new GalleryStrip(this.find("strip"));
    this.picture = this.find("picture");
    this.shownScene = null;
    this.shownPair = "";
  }

  find(id) {
    return document.getElementById(id);
  }

  start() {
    SharedView.of("gallery").whole = true;
    new ResizeObserver(() => this.fitWall()).observe(this.find("wall"));
    this.walk.read(location.hash);
    this.onClick("[data-scene]", (button) => {
      this.walk.enter(Number(button.dataset.scene));
    });
    this.onClick("[data-mode]", (button) => {
      this.walk.mode = button.dataset.mode;
    });
    this.onClick("[data-go]", (button) => {
      this.walk.go(Number(button.dataset.go));
      this.find("wall").scrollIntoView({ block: "nearest" });
    });
    this.onClick("[data-side]", (button) => this.walk.pick(button.dataset.side, Number(button.dataset.of)));
    this.onClick("#previous", () => this.walk.move(-1));
    this.onClick("#next", () => this.walk.move(1));
    document.addEventListener("keydown", (event) => this.key(event));
    this.find("walk").hidden = false;
    this.find("strip").classList.add("live");
    this.show();
  }

  onClick(which, act) {
    for (const button of document.querySelectorAll(which)) {
      button.addEventListener("click", () => {
        act(button);
        this.show();
      });
    }
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) {
      return;
    }
    const acts = {
      n: () => this.walk.move(1),
      p: () => this.walk.move(-1),
      s: () => {
        this.walk.enter((this.walk.scene + 1) % this.walk.scenes);
      },
    };
    if (Object.hasOwn(acts, event.key)) {
      acts[event.key]();
      this.show();
    }
  }

  get scene() {
    return this.data.scenes[this.walk.scene];
  }

  /** So wide that the whole picture leaves no gap at its sides; smaller than it is where there is no room. */
  fitWall() {
    const stage = this.picture.querySelector(".compare-stage");
    if (stage) {
      const border = this.picture.clientWidth - stage.clientWidth;
      const width = this.scene.width * wholeScale((this.find("wall").clientWidth - border) / this.scene.width);
      this.picture.style.maxWidth = `${width + border}px`;
    }
  }

  /** What hangs on one side: a shot, and what it is called. */
  side(which) {
    const own = this.walk.mode === "mine";
    const step = own ? this.walk.right : this.walk[which];
    const { number, title } = this.data.steps[step];
    const shots = own && which === "right" ? this.scene.mine : this.scene.reference;
    return { shot: shots[step], name: own ? (which === "right" ? "yours" : "reference") : `${number} ${title}` };
  }

  show() {
    const { walk, scene } = this;
    if (scene !== this.shownScene) {
      this.strip.picturesOf(scene, this.data.pictures);
      this.find("scene-words").textContent = scene.words;
      this.shownScene = scene;
    }
    const [left, right] = [this.side("left"), this.side("right")];
    this.hang(left, right);
    this.tell(left, right);
    this.strip.mark(walk);
    const press = (which, chosen) =>
      document.querySelectorAll(which).forEach((button) => {
        button.setAttribute("aria-pressed", String(chosen(button)));
      });
    press("[data-scene]", (button) => Number(button.dataset.scene) === walk.scene);
    press("[data-mode]", (button) => button.dataset.mode === walk.mode);
    this.find("previous").disabled = !walk.canMoveBack;
    this.find("next").disabled = !walk.canMoveOn;
    history.replaceState(null, "", walk.write() || location.pathname);
  }

  /** The two pictures under the slider, or why one of them is missing. */
  hang(left, right) {
    const missing = [left, right].filter(({ shot }) => shot.picture === null);
    this.picture.hidden = missing.length > 0;
    this.find("empty").hidden = missing.length === 0;
    this.find("empty").textContent = missing.map(({ name, shot }) => `${name}: ${shot.note}`).join("\n");
    const pair = `${this.walk.scene}/${left.name}/${left.shot.picture}/${right.name}/${right.shot.picture}`;
    if (missing.length > 0 || pair === this.shownPair) {
      return;
    }
    this.shownPair = pair;
    const picture = ({ name, shot }) => ({
      src: this.data.pictures[shot.picture],
      name,
      alt: `${this.scene.title}: ${name}`,
    });
    const focused = this.picture.contains(document.activeElement);
    this.picture.setAttribute("label", this.scene.title);
    this.picture.setPictures({ reference: picture(left), mine: picture(right) });
    this.fitWall();
    if (focused) {
      this.picture.querySelector("[tabindex='0']")?.focus();
    }
  }

  /** The plate beside the picture. */
  tell(left, right) {
    const step = this.data.steps[this.walk.right];
    const { overview } = this.walk;
    this.find("left-name").textContent = left.name;
    this.find("right-name").textContent = right.name;
    this.find("plate-title").textContent = overview ? document.title : `${step.number} ${step.title}`;
    this.find("new").textContent = overview
      ? this.walk.left === 0
        ? "To the left, all that a first ray knows: where it goes. To the right, what the same ray brings back in the end."
        : `To the left, the scene after step ${left.name}. To the right, after step ${right.name}.`
      : step.new;
    this.find("next").firstChild.textContent = overview ? "Begin the walk " : "Next ";
    this.find("same").hidden =
      left.shot.picture === null ||
      left.shot.picture !== right.shot.picture ||
      (this.walk.mode === "steps" && this.walk.left === this.walk.right);
    this.find("note").textContent = right.shot.picture === null ? "" : right.shot.note;
    this.find("note").hidden = this.find("note").textContent === "";
    showGalleryWork(this.find("work"), overview ? [] : (this.scene.work[step.index] ?? []), this.data.pictures);
  }
}

new Gallery(JSON.parse(document.getElementById("data").textContent)).start();
