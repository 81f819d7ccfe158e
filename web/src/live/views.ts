// Switches between the views of the page. The address after '#' selects a view.
import { element } from "../page/dom.js";

export interface LiveView {
    /** Called when the view is opened, and when the size or the colour scheme of the window changes. */
    redraw(): void;
    hidden?(): void;
}

export class Views {
    readonly #views: Record<string, LiveView>;
    #current: string;

    /** The page initially shows the first view. The element with the id `view-NAME` contains view NAME. */
    constructor(views: Record<string, LiveView>) {
        this.#views = views;
        this.#current = Object.keys(views)[0]!;
        addEventListener("hashchange", () => this.#route());
        addEventListener("resize", () => this.redraw());
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
        this.#route();
    }

    redraw(): void {
        this.#views[this.#current]!.redraw();
    }

    #route(): void {
        const asked = location.hash.slice(1);
        const name = asked in this.#views ? asked : Object.keys(this.#views)[0]!;
        const before = this.#current;
        this.#current = name;
        for (const view of Object.keys(this.#views)) element(`view-${view}`, HTMLElement).hidden = view !== name;
        for (const link of document.querySelectorAll<HTMLAnchorElement>("nav a")) {
            if (link.dataset["view"] === name) link.setAttribute("aria-current", "page");
            else link.removeAttribute("aria-current");
        }
        if (name !== before) {
            this.#views[before]!.hidden?.();
            // Moves the keyboard and screen reader focus to the new content.
            element("content", HTMLElement).focus({ preventScroll: true });
            scrollTo(0, 0);
        }
        this.redraw();
    }
}
