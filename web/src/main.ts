// Starts the page. The part of the address after '#' selects one of the three views.
import { Engine } from "./engine/engine.js";
import { LookView } from "./look/look.js";
import { element, show } from "./page/dom.js";
import { startOffline } from "./page/offline.js";
import type { View } from "./page/view.js";
import { PrintView } from "./print/print.js";
import { TryView } from "./try/try.js";

const engine = new Engine();
const views: Record<string, View> = {
    try: new TryView(engine),
    look: new LookView(engine),
    print: new PrintView(engine),
};
const kTitles: Record<string, string> = {
    try: "dotpose: where am I on this sheet?",
    look: "dotpose: look through your camera",
    print: "dotpose: print a sheet",
};
let current = "";

function fail(error: unknown): void {
    element("failure", HTMLElement).hidden = false;
    show({ failure: `This browser cannot run the page: ${error instanceof Error ? error.message : String(error)}` });
}

function route(): void {
    const asked = location.hash.slice(1);
    const name = asked in views ? asked : "try";
    if (name === current) return;
    if (current !== "") views[current]!.hidden();
    for (const view of Object.keys(views)) element(`view-${view}`, HTMLElement).hidden = view !== name;
    for (const link of document.querySelectorAll<HTMLAnchorElement>("nav a")) {
        if (link.dataset["view"] === name) link.setAttribute("aria-current", "page");
        else link.removeAttribute("aria-current");
    }
    // Moves the keyboard and screen reader focus to the content, except when the page is first
    // opened.
    if (current !== "") element("content", HTMLElement).focus({ preventScroll: true });
    if (current !== "") scrollTo(0, 0);
    current = name;
    document.title = kTitles[name]!;
    Promise.resolve(views[name]!.shown()).catch(fail);
}

const redraw = () => views[current]?.redraw();
addEventListener("hashchange", route);
addEventListener("resize", redraw);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
route();
startOffline();
