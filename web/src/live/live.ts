// The page of `dotpose watch --web`: a live view of what the program sees.
import { announcer, element, show } from "../page/dom.js";
import { Connection, type Value } from "./connection.js";
import { PathMap } from "./map.js";
import { sourceText, type Advice, type History, type Path, type Setup, type State } from "./messages.js";
import { Picture } from "./picture.js";
import { placeOf, showState } from "./readout.js";
import { Recorder } from "./recorder.js";
import { Refusals } from "./refusals.js";
import { SheetsView } from "./sheets.js";
import { showSpace } from "./space.js";
import { Views } from "./views.js";

const announce = announcer("live-announced");
const connection = new Connection((is_open) => {
    element("live-status", HTMLElement).classList.toggle("good", is_open);
    show({ "live-status": is_open ? "live" : "no connection to dotpose" });
    if (is_open) return;
    announce("No connection to dotpose");
    sheets.disconnected();
});
const map = new PathMap();
const refusals = new Refusals();
const recorder = new Recorder(connection);
const picture = new Picture(connection);
const sheets = new SheetsView(connection);
let setup: Setup | null = null;
/** Reason why a frame was refused, and advice. Empty if the reason is not known. */
let reason = "";

function showSetup(value: Setup): void {
    setup = value;
    map.setUp(value);
    recorder.setUp(value);
    sheets.setUp(value);
    show({ "live-source": sourceText(value), "live-robot": value.robot });
    document.title = `${value.robot}: dotpose`;
}

function takeState(state: State): void {
    showState(state, setup);
    showSpace(state.line);
    map.takeLine(state.line);
    recorder.take(state);
    sheets.takeLine(state.line);
    showResult(state.line.status);
    const place = placeOf(state.line, setup);
    announce(place ? `x ${place.x_mm.toFixed(1)}, y ${place.y_mm.toFixed(1)} mm` : "lost");
}

/**
 * Shows whether the newest frame was located. The program needs some time to find the reason for a refusal. Until the
 * reason arrives, the name of the status is shown.
 */
function showResult(status: string): void {
    const is_good = status === "ok";
    const refusal = reason === "" ? `${status.replaceAll("_", " ")}. Looking for the reason …` : `${reason}.`;
    show({ "live-advice": is_good ? "The newest frame was located." : `Refused: ${refusal}` });
    element("live-advice", HTMLElement).classList.toggle("good", is_good);
}

function subscribe<T>(topic: string, take: (value: T) => unknown): void {
    connection.subscribe(topic, async (value: Value) => {
        take(JSON.parse(value as string) as T);
        await new Promise(requestAnimationFrame);
    });
}

subscribe<Setup>("setup", showSetup);
subscribe<State>("state", takeState);
subscribe<History>("history", (history) => refusals.take(history));
subscribe<Path>("path", (path) => map.takePath(path));
subscribe<Advice>("advice", (advice) => (reason = advice.reason));
connection.open();

new Views({
    live: {
        redraw(): void {
            picture.request();
            picture.redraw();
            map.redraw();
            refusals.redraw();
        },
        hidden: () => picture.request(),
    },
    sheets,
});
