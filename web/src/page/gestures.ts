// Mouse, touch and keyboard gestures on a camera picture or a map.

export interface Gestures {
    /** Moves the picture by a number of CSS pixels. */
    drag(dx: number, dy: number): void;
    turn(degrees: number): void;
    /** Multiplies the height of the camera, or the extent of the map, by a factor. */
    rise(factor: number): void;
    /** Called at the start of any gesture. */
    begin(): void;
}

interface Finger {
    x: number;
    y: number;
}

function listenToPointers(canvas: HTMLCanvasElement, gestures: Gestures): void {
    const fingers = new Map<number, Finger>();
    const span = () => {
        const [a, b] = [...fingers.values()] as [Finger, Finger];
        return { length: Math.hypot(b.x - a.x, b.y - a.y), angle: Math.atan2(b.y - a.y, b.x - a.x) };
    };
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        gestures.begin();
    });
    canvas.addEventListener("pointermove", (event) => {
        const finger = fingers.get(event.pointerId);
        if (finger === undefined) return;
        const before = fingers.size === 2 ? span() : null;
        const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
        Object.assign(finger, { x: event.clientX, y: event.clientY });
        gestures.drag(dx / fingers.size, dy / fingers.size);
        if (before === null) return;
        const after = span();
        gestures.turn(((before.angle - after.angle) * 180) / Math.PI);
        if (after.length > 0) gestures.rise(before.length / after.length);
    });
    for (const type of ["pointerup", "pointercancel"] as const)
        canvas.addEventListener(type, (event) => fingers.delete(event.pointerId));
}

/**
 * Step sizes for the keys: distances in CSS pixels, an angle in degrees, and the factor by which the height changes.
 */
const kStep = 12;
const kFarStep = 120;
const kTurn = 5;
const kRise = 1.06;

function listenToKeys(canvas: HTMLCanvasElement, gestures: Gestures): void {
    canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const step = event.shiftKey ? kFarStep : kStep;
        const actions: Record<string, () => void> = {
            ArrowLeft: () => gestures.drag(step, 0),
            ArrowRight: () => gestures.drag(-step, 0),
            ArrowUp: () => gestures.drag(0, step),
            ArrowDown: () => gestures.drag(0, -step),
            q: () => gestures.turn(-kTurn),
            e: () => gestures.turn(kTurn),
            "+": () => gestures.rise(kRise),
            "=": () => gestures.rise(kRise),
            "-": () => gestures.rise(1 / kRise),
        };
        const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
        if (action === undefined) return;
        event.preventDefault();
        gestures.begin();
        action();
    });
}

/** Calls the functions in `gestures` when the user makes gestures on the picture. */
export function listen(canvas: HTMLCanvasElement, gestures: Gestures): void {
    listenToPointers(canvas, gestures);
    listenToKeys(canvas, gestures);
    canvas.addEventListener(
        "wheel",
        (event) => {
            // The wheel changes the height only if the picture has the focus. Otherwise it scrolls
            // the page.
            if (document.activeElement !== canvas) return;
            event.preventDefault();
            gestures.begin();
            gestures.rise(event.deltaY > 0 ? kRise : 1 / kRise);
        },
        { passive: false },
    );
}
