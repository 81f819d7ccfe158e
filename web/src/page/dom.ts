// Helper functions for the elements in index.html.

/** Returns the element with the given id. Throws an error if it is missing or has another type. */
export function element<T extends Element>(id: string, type: new () => T): T {
    const found = document.getElementById(id);
    if (!(found instanceof type)) throw new Error(`index.html has no ${type.name} #${id}`);
    return found;
}

/** Sets the text of elements. `texts` maps the id of each element to its new text. */
export function show(texts: Record<string, string>): void {
    for (const [id, text] of Object.entries(texts)) {
        const target = document.getElementById(id)!;
        if (target.textContent !== text) target.textContent = text;
    }
}

/** Returns a new element with the given children. */
export function make<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    properties: Partial<HTMLElementTagNameMap[K]> = {},
    ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
}

/**
 * Returns a function that writes text to a live region, at most once every three seconds.
 */
export function announcer(id: string): (text: string) => void {
    const kPause_ms = 3000;
    let last_ms = -kPause_ms;
    return (text) => {
        const now_ms = performance.now();
        if (now_ms - last_ms < kPause_ms) return;
        last_ms = now_ms;
        show({ [id]: text });
    };
}

/** Offers a file as a download. */
export function download(name: string, type: string, content: BlobPart): void {
    const url = URL.createObjectURL(new Blob([content], { type }));
    const link = make("a", { href: url, download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
