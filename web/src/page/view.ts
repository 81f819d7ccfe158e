/** A view of the page. Only one view is shown at a time. */
export interface View {
    shown(): Promise<void> | void;
    hidden(): void;
    /** Called when the size or the colour scheme of the window changes. */
    redraw(): void;
}
