// The page of `dotpose fleet --web`: a live view of all robots that publish to a broker.
import { Connection, type Request, type Value } from "../live/connection.js";
import { announcer, element, show } from "../page/dom.js";
import { HistoryPanel } from "./history.js";
import { FleetMap } from "./map.js";
import type { Robot, Setup, Summary, Table } from "./messages.js";
import { RobotPanel } from "./robot.js";
import { SummaryView } from "./summary.js";
import { RobotTable } from "./table.js";

const announce = announcer("fleet-announced");
const connection = new Connection((is_open) => {
    element("live-status", HTMLElement).classList.toggle("good", is_open);
    show({ "live-status": is_open ? "live" : "no connection to dotpose" });
    if (is_open) return;
    announce("No connection to dotpose");
    // Deselects the robot. The program may have been restarted, and would then assign new numbers to the robots.
    panel.choose(null);
});
const panel: RobotPanel = new RobotPanel(connection, takeRobot, ({ map, x_mm, y_mm, path_mm }) => {
    const x = x_mm ?? path_mm.at(-2);
    const y = y_mm ?? path_mm.at(-1);
    if (map !== undefined && x !== undefined && y !== undefined) fleet_map.showPlace(map, x, y);
});
const table = new RobotTable(connection, (id) => panel.choose(id, true));
const fleet_map = new FleetMap(connection, (id) => panel.choose(id));
const history = new HistoryPanel(connection, (tracks) => fleet_map.takeTracks(tracks));
/**
 * True on the page of `dotpose listen` until its only robot appears. The page then chooses this robot.
 */
let awaits_device = false;
const summary = new SummaryView(announce, (state) => {
    table.showOnly(state);
    element("fleet-table", HTMLElement).scrollIntoView({ block: "start" });
});

function takeRobot(robot: Robot | null): void {
    table.takeChosen(robot?.id ?? null);
    fleet_map.takeChosen(robot);
    history.choose(robot?.name ?? "");
}

function takeTable(value: Table): void {
    table.take(value);
    const only = value.rows[0];
    if (!awaits_device || only === undefined) return;
    awaits_device = false;
    panel.choose(only.id);
}

function subscribe<T>(topic: string, take: (value: T) => unknown, request: Request = {}): void {
    const taken = async (value: Value) => {
        take(JSON.parse(value as string) as T);
        await new Promise(requestAnimationFrame);
    };
    connection.subscribe(topic, taken, request);
}

subscribe<Setup>("setup", (value) => {
    fleet_map.setUp(value);
    history.enable(value.has_history);
    awaits_device = value.device !== "";
    element("fleet-remove", HTMLButtonElement).hidden = awaits_device;
    const title = value.device || (value.map === "" ? "Fleet" : `Fleet of ${value.map}`);
    show({ "fleet-title": title });
    document.title = `${title}: dotpose`;
});
subscribe<Summary>("summary", (value) => {
    summary.take(value);
    fleet_map.takeMaps(value.maps);
});
subscribe<Table>("table", takeTable, table.request());
subscribe<Robot | null>("robot", (value) => panel.take(value), panel.request());
connection.open();

function redraw(): void {
    fleet_map.redraw();
    history.redraw();
}
window.addEventListener("resize", redraw);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
