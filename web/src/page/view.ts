/** A part of the page, of which one is shown at a time. */
export interface View {
    shown(): Promise<void> | void;
    hidden(): void;
    /** The window has another size, or it became light or dark. */
    redraw(): void;
}
