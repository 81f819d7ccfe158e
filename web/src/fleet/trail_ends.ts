// Extends the trails of the robots to their newest positions. Trails arrive only once per second, so each trail is
// followed by an end, which contains the positions that arrived after the trail.
import type { Positions, Trails } from "./messages.js";

/**
 * Maximum number of robots for which the trail ends contain all positions. With more robots, the trail ends are too
 * short on the screen to appear as curves, so only the newest position is kept.
 */
const kMaxRobots = 500;
/** Maximum number of positions in the end of a trail. The limit bounds the memory used by a page that
 * receives no trails for some time. */
const kMaxPoints = 100;

export class TrailEnds {
    #trails: Trails | null = null;
    /** Points from the end of each trail to the newest position, as alternating x and y, by robot number. */
    readonly #ends_mm = new Map<number, number[]>();

    get trails(): Trails | null {
        return this.#trails;
    }
    get ends_mm(): Iterable<readonly number[]> {
        return this.#ends_mm.values();
    }

    /** Replaces the trails. Each end then restarts at the last point of its new trail. */
    takeTrails(trails: Trails | null): void {
        this.#trails = trails;
        this.#ends_mm.clear();
        for (const [id, trail] of trails?.trails_mm ?? [])
            if (trail.length > 0) this.#ends_mm.set(id, [trail[trail.length - 2]!, trail[trail.length - 1]!]);
    }

    takePositions(positions: Positions): void {
        const max = this.#ends_mm.size > kMaxRobots ? 2 : kMaxPoints;
        for (let i = 0; i < positions.count; ++i) {
            const end = this.#ends_mm.get(positions.id(i));
            if (end === undefined) continue;
            if (end.length >= 2 * max) end.length = 2 * max - 2;
            end.push(positions.x_mm(i), positions.y_mm(i));
        }
    }
}
